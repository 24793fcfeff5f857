#include "sample_game/support/built_in_scenes/ear_clipping.h"

#include <algorithm>
#include <numeric>

namespace gnomon::game {
namespace {

/// Returns twice the signed area; above 0: counter-clockwise.
double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool holds(const std::array<glm::dvec2, 3>& triangle, const glm::dvec2& p) {
    return area2(triangle[0], triangle[1], p) >= 0.0 && area2(triangle[1], triangle[2], p) >= 0.0 &&
           area2(triangle[2], triangle[0], p) >= 0.0;
}

bool is_ear(std::span<const glm::dvec2> polygon, const std::vector<std::uint32_t>& left, std::size_t at) {
    const std::size_t count = left.size();
    const std::uint32_t before = left[(at + count - 1) % count], here = left[at], after = left[(at + 1) % count];
    const std::array<glm::dvec2, 3> ear{polygon[before], polygon[here], polygon[after]};
    if (!(area2(ear[0], ear[1], ear[2]) > 0.0)) return false;
    return std::none_of(left.begin(), left.end(), [&](std::uint32_t i) {
        return i != before && i != here && i != after && holds(ear, polygon[i]);
    });
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec2> polygon) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> left(polygon.size());
    std::iota(left.begin(), left.end(), 0u);
    while (left.size() >= 3) {
        std::size_t ear = 0;
        while (ear < left.size() && !is_ear(polygon, left, ear)) ++ear;
        if (ear == left.size()) break;
        const std::size_t count = left.size();
        triangles.push_back({left[(ear + count - 1) % count], left[ear], left[(ear + 1) % count]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
}

}  // namespace gnomon::game
