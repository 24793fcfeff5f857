#include "tests/oracle/far_errors.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/oracle/pixel_ray.h"

namespace gnomon::oracle {
namespace {

bool on_one_plane(const PrimaryHits& hits, std::size_t a, std::size_t b) {
    if (hits.triangle[a] == hits.triangle[b]) return true;
    if (hits.triangle[a] == kNoTriangle || hits.triangle[b] == kNoTriangle) return false;
    const glm::dvec3 apart_m = hits.position_rel_m[b] - hits.position_rel_m[a];
    const double least_m = kPlaneTolerance * glm::distance(hits.position_rel_m[a], hits.camera_rel_m);
    return std::abs(glm::dot(hits.normal_ws[a], apart_m)) <= least_m &&
           std::abs(glm::dot(hits.normal_ws[b], apart_m)) <= least_m;
}

class Search {
public:
    Search(const ComparedPictures& pictures, std::span<const std::uint8_t> creases)
        : p_(pictures), creases_(creases), width_(pictures.size_px.x), height_(pictures.size_px.y) {}

    /// Returns whether the middle between two neighbours lies within `reach_px` of the pixel's centre. Neighbours count
    /// for which `parts(pixel, neighbour, crease bit)` is true.
    template <class Parts>
    bool any_within(std::size_t pixel, double reach_px, Parts parts) const {
        const auto x = static_cast<long>(pixel % width_), y = static_cast<long>(pixel / width_);
        const long reach = static_cast<long>(reach_px) + 1;
        const long right = std::min(x + reach, static_cast<long>(width_) - 1);
        const long top = std::min(y + reach, static_cast<long>(height_) - 1);
        for (long v = std::max(y - reach, 0L); v <= top; ++v)
            for (long u = std::max(x - reach, 0L); u <= right; ++u) {
                const std::size_t at = static_cast<std::size_t>(v) * width_ + static_cast<std::size_t>(u);
                const auto dx = static_cast<double>(u - x), dy = static_cast<double>(v - y);
                if (u < right && std::hypot(dx + 0.5, dy) <= reach_px && parts(at, at + 1, kCreaseRight)) return true;
                if (v < top && std::hypot(dx, dy + 0.5) <= reach_px && parts(at, at + width_, kCreaseUp)) return true;
            }
        return false;
    }
    bool near_edge(std::size_t pixel, double reach_px) const {
        return any_within(pixel, reach_px, [&](std::size_t a, std::size_t b, std::uint8_t) {
            return p_.scored[a] != 0 && p_.scored[b] != 0 && lit(p_.truth[a]) != lit(p_.truth[b]);
        });
    }
    bool near_crease(std::size_t pixel, double reach_px) const {
        return any_within(pixel, reach_px,
                          [&](std::size_t a, std::size_t, std::uint8_t bit) { return (creases_[a] & bit) != 0; });
    }
    /// Returns whether the picture's border is within reach. Edges beyond it are not known.
    bool near_border(std::size_t pixel, double reach_px) const {
        const std::size_t x = pixel % width_, y = pixel / width_;
        return static_cast<double>(std::min({x, y, width_ - 1 - x, height_ - 1 - y})) < reach_px;
    }
    static bool lit(float visibility) { return visibility >= 0.5f; }

private:
    const ComparedPictures& p_;
    std::span<const std::uint8_t> creases_;
    std::size_t width_, height_;
};

/// Returns whether the truth somewhere within reach differs from the truth at the pixel's centre. Searches in rings,
/// outward.
bool changes_within(std::size_t pixel, double reach_px, bool lit_there, const LitBetween& lit) {
    const int rings = static_cast<int>(reach_px * kBetween);
    for (int ring = 1; ring <= rings; ++ring)
        for (int y = -ring; y <= ring; ++y)
            for (int x = -ring; x <= ring; x += std::abs(y) == ring ? 1 : 2 * ring) {
                const glm::dvec2 offset_px = glm::dvec2(x, y) / static_cast<double>(kBetween);
                if (glm::length(offset_px) <= reach_px && lit(pixel, offset_px) != lit_there) return true;
            }
    return false;
}

}  // namespace

std::vector<std::uint8_t> creases(const PrimaryHits& hits) {
    std::vector<std::uint8_t> flags(hits.count());
    const std::size_t width = hits.size_px.x, height = hits.size_px.y;
    for (std::size_t i = 0; i < flags.size(); ++i) {
        if (i % width + 1 < width && !on_one_plane(hits, i, i + 1)) flags[i] |= kCreaseRight;
        if (i / width + 1 < height && !on_one_plane(hits, i, i + width)) flags[i] |= kCreaseUp;
    }
    return flags;
}

LitBetween lit_between(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                       const LightItem& light) {
    return [&](std::size_t pixel, const glm::dvec2& offset_px) {
        const glm::dvec2 centre_px(pixel % hits.size_px.x, pixel / hits.size_px.x);
        const ExactRay ray = pixel_ray(consumer, hits.camera_rel_m, centre_px + offset_px).ray;
        const glm::dvec3 &p = hits.position_rel_m[pixel], &n = hits.normal_ws[pixel];
        const glm::dvec3 there =
            ray.origin + ray.direction * (glm::dot(n, p - ray.origin) / glm::dot(n, ray.direction));
        return !tracer.blocked(there, hits.triangle[pixel], light, 0.0);
    };
}

FarErrors far_errors(const ComparedPictures& pictures, std::span<const std::uint8_t> creases,
                     std::span<const float> allowed_px, const LitBetween& lit) {
    assert(creases.size() == pictures.truth.size() && allowed_px.size() == pictures.truth.size());
    const Search search(pictures, creases);
    FarErrors errors;
    for (std::size_t i = 0; i < pictures.truth.size(); ++i) {
        if (pictures.scored[i] == 0 || pictures.ambiguous[i] != 0 || !(pictures.measured[i] >= 0.0f)) continue;
        const bool shown_lit = Search::lit(pictures.measured[i]);
        if (shown_lit == Search::lit(pictures.truth[i])) continue;
        const double reach_px = std::max(kEdgeBandPx, static_cast<double>(allowed_px[i]));
        if (search.near_edge(i, reach_px)) continue;
        if (search.near_border(i, reach_px) || search.near_crease(i, reach_px)) {
            ++(shown_lit ? errors.crease_light : errors.crease_shadow);
        } else if (errors.each.size() >= kMostUnexplained ||
                   !changes_within(i, reach_px, Search::lit(pictures.truth[i]), lit)) {
            ++(shown_lit ? errors.false_light : errors.false_shadow);
            errors.each.push_back(i);
        }
    }
    return errors;
}

}  // namespace gnomon::oracle
