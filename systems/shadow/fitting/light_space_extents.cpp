#include "systems/shadow/fitting/light_space_extents.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace gnomon::shadow {
namespace {

/// One coordinate of two points. Every 64-bit processor handles two doubles at once, but compilers do not vectorise a
/// minimum and a maximum by themselves.
using Pair __attribute__((vector_size(2 * sizeof(double)))) = double;

constexpr Pair both(double value) { return Pair{value, value}; }

class Reach {
public:
    explicit Reach(const glm::dvec3& axis) : x_(both(axis.x)), y_(both(axis.y)), z_(both(axis.z)) {}

    void include(const Pair& x, const Pair& y, const Pair& z) {
        const Pair at = x_ * x + y_ * y + z_ * z;
        low_ = at < low_ ? at : low_;
        high_ = at > high_ ? at : high_;
    }
    double low() const { return std::min(low_[0], low_[1]); }
    double high() const { return std::max(high_[0], high_[1]); }

private:
    Pair x_, y_, z_;
    Pair low_ = both(std::numeric_limits<double>::infinity()), high_ = -low_;
};

}  // namespace

Extents extents_along(const glm::dmat3& axes, std::span<const glm::dvec3> points) {
    std::array<Reach, 3> along = {Reach(axes[0]), Reach(axes[1]), Reach(axes[2])};
    const auto include = [&](const glm::dvec3& p, const glm::dvec3& q) {
        const Pair x{p.x, q.x}, y{p.y, q.y}, z{p.z, q.z};
        for (Reach& reach : along) reach.include(x, y, z);
    };
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) include(points[i], points[i + 1]);
    if (points.size() % 2 == 1) include(points.back(), points.back());
    return {{along[0].low(), along[1].low(), along[2].low()}, {along[0].high(), along[1].high(), along[2].high()}};
}

}  // namespace gnomon::shadow
