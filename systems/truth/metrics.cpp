#include "systems/truth/metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <vector>

namespace gnomon::truth {
namespace {

constexpr float kHalf = 0.5f;
constexpr double kSearchStepPx = 0.25;
constexpr double kTail = 0.95, kFarTail = 0.99;
constexpr int kGradientReachPx = 2;

struct Pixel {
    int x = 0, y = 0;
};

class Comparison {
public:
    explicit Comparison(const ComparedPictures& pictures)
        : p_(pictures), width_(static_cast<int>(p_.size_px.x)), height_(static_cast<int>(p_.size_px.y)) {}

    Metrics run() const {
        Metrics m;
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) count_pixel({x, y}, m);
        m.wrong = m.false_shadow + m.false_light + m.uncovered;
        m.edge = edge_displacement();
        return m;
    }

private:
    std::size_t index(Pixel q) const {
        return static_cast<std::size_t>(q.y) * p_.size_px.x + static_cast<std::size_t>(q.x);
    }
    bool in_picture(Pixel q) const { return q.x >= 0 && q.y >= 0 && q.x < width_ && q.y < height_; }
    bool scored(Pixel q) const { return in_picture(q) && p_.scored[index(q)] != 0; }
    bool lit(Pixel q) const { return p_.truth[index(q)] >= kHalf; }
    bool edge_between(Pixel a, Pixel b) const { return scored(a) && scored(b) && lit(a) != lit(b); }

    void count_pixel(Pixel q, Metrics& m) const {
        const std::size_t i = index(q);
        const bool surface = p_.truth[i] >= 0.0f;
        const bool measured_surface = p_.measured[i] >= 0.0f;  // false for NaN
        if (surface != measured_surface) ++m.coverage_mismatch;
        if (!p_.scored[i]) return;
        if (p_.ambiguous[i]) {
            ++m.ambiguous;
            return;
        }
        ++m.scored;
        if (!measured_surface) {
            ++m.uncovered;
            return;
        }
        const bool measured_lit = p_.measured[i] >= kHalf;
        if (measured_lit == lit(q)) return;
        const bool far = far_from_edges(q);
        (measured_lit ? m.false_light : m.false_shadow) += 1;
        if (far) (measured_lit ? m.leak : m.acne) += 1;
    }

    // Uses the distance from the pixel's centre to the midpoints between differing neighbours.
    bool far_from_edges(Pixel q) const {
        const int reach = static_cast<int>(kEdgeBandPx) + 1;
        for (int y = q.y - reach; y <= q.y + reach; ++y)
            for (int x = q.x - reach; x <= q.x + reach; ++x) {
                if (edge_between({x, y}, {x + 1, y}) && std::hypot(x + 0.5 - q.x, y - q.y) <= kEdgeBandPx) return false;
                if (edge_between({x, y}, {x, y + 1}) && std::hypot(x - q.x, y + 0.5 - q.y) <= kEdgeBandPx) return false;
            }
        return true;
    }

    // Estimates the gradient toward the light in a window around the edge; `across` (from shadow to light) if the
    // window is balanced.
    glm::dvec2 gradient(Pixel a, Pixel b, const glm::dvec2& across) const {
        glm::dvec2 sum(0.0);
        const glm::dvec2 middle = 0.5 * glm::dvec2(a.x + b.x, a.y + b.y);
        for (int y = std::min(a.y, b.y) - kGradientReachPx; y <= std::max(a.y, b.y) + kGradientReachPx; ++y)
            for (int x = std::min(a.x, b.x) - kGradientReachPx; x <= std::max(a.x, b.x) + kGradientReachPx; ++x)
                if (scored({x, y})) sum += (glm::dvec2(x, y) - middle) * (lit({x, y}) ? 1.0 : -1.0);
        return glm::dot(sum, across) > 0.0 ? glm::normalize(sum) : across;
    }

    // Interpolates bilinearly; nothing if a contributing pixel is not scored or has no surface.
    std::optional<double> measured_at(const glm::dvec2& place) const {
        const glm::dvec2 base = glm::floor(place);
        const glm::dvec2 f = place - base;
        double value = 0.0;
        for (int dy = 0; dy <= 1; ++dy)
            for (int dx = 0; dx <= 1; ++dx) {
                const double share = (dx ? f.x : 1.0 - f.x) * (dy ? f.y : 1.0 - f.y);
                if (!(share > 0.0)) continue;
                const Pixel q{static_cast<int>(base.x) + dx, static_cast<int>(base.y) + dy};
                if (!scored(q) || !(p_.measured[index(q)] >= 0.0f)) return std::nullopt;
                value += share * static_cast<double>(p_.measured[index(q)]);
            }
        return value;
    }

    // Finds the place nearest to `middle` where the measured value rises through one half along `rise`, in both
    // directions. Sets `left_scored` if one side left the scored pixels before the search ended, because a nearer edge
    // may be hidden there. An edge exactly here counts whatever the pixels beside it, so that a picture has distance 0
    // to itself.
    std::optional<double> nearest_rise(const glm::dvec2& middle, const glm::dvec2& across, const glm::dvec2& rise,
                                       bool& left_scored) const {
        const double half = static_cast<double>(kHalf);
        const auto first = measured_at(middle), dark = measured_at(middle - 0.5 * across);
        left_scored = !first;
        if (!first) return std::nullopt;
        if (std::equal_to<double>()(*first, half) && *dark < half) return 0.0;
        std::optional<double> ahead = first, behind = first;
        for (double s = kSearchStepPx; s <= kEdgeSearchPx && ahead && behind; s += kSearchStepPx) {
            const auto next = measured_at(middle + rise * s), last = measured_at(middle - rise * s);
            if (next && *ahead <= half && *next > half)
                return s - kSearchStepPx + kSearchStepPx * (half - *ahead) / (*next - *ahead);
            if (last && *behind >= half && *last < half)
                return -(s - kSearchStepPx + kSearchStepPx * (*behind - half) / (*behind - *last));
            ahead = next;
            behind = last;
        }
        left_scored = !ahead || !behind;
        return std::nullopt;
    }

    void measure_place(Pixel a, Pixel b, EdgeDisplacement& edge, std::vector<double>& distances) const {
        if (!edge_between(a, b)) return;
        const glm::dvec2 step(b.x - a.x, b.y - a.y);
        const glm::dvec2 across = lit(b) ? step : -step;
        bool left_scored = false;
        const glm::dvec2 middle = 0.5 * glm::dvec2(a.x + b.x, a.y + b.y);
        const glm::dvec2 rise = gradient(a, b, across);
        const auto found = nearest_rise(middle, across, rise, left_scored);
        if (!found && left_scored) {
            ++edge.unmeasured;
            return;
        }
        ++edge.places;
        if (!found) ++edge.lost;
        if (found) edge.mean_signed_px += *found;
        distances.push_back(found ? std::abs(*found) : kEdgeSearchPx);
        edge.each.push_back({distances.back(), index(lit(b) ? a : b), index(lit(b) ? b : a), middle, rise});
    }

    EdgeDisplacement edge_displacement() const {
        EdgeDisplacement edge;
        std::vector<double> distances;
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                measure_place({x, y}, {x + 1, y}, edge, distances);
                measure_place({x, y}, {x, y + 1}, edge, distances);
            }
        if (distances.empty()) return edge;
        std::sort(distances.begin(), distances.end());
        const auto count = static_cast<double>(distances.size());
        const std::size_t found = edge.places - edge.lost;
        edge.mean_signed_px = found == 0 ? 0.0 : edge.mean_signed_px / static_cast<double>(found);
        edge.mean_px = std::accumulate(distances.begin(), distances.end(), 0.0) / count;
        edge.p95_px = distances[static_cast<std::size_t>(std::ceil(kTail * count)) - 1];
        edge.p99_px = distances[static_cast<std::size_t>(std::ceil(kFarTail * count)) - 1];
        edge.max_px = distances.back();
        return edge;
    }

    const ComparedPictures& p_;
    int width_, height_;
};

}  // namespace

Metrics compare(const ComparedPictures& pictures) {
    [[maybe_unused]] const std::size_t count = std::size_t{pictures.size_px.x} * pictures.size_px.y;
    assert(pictures.measured.size() == count && pictures.truth.size() == count);
    assert(pictures.scored.size() == count && pictures.ambiguous.size() == count);
    return Comparison(pictures).run();
}

}  // namespace gnomon::truth
