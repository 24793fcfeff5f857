#include "systems/shadow/exact/facet_depth_range.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "systems/shadow/exact/clip_error.h"
#include "systems/shadow/exact/error_margins.h"

namespace gnomon::shadow {
namespace {

/// Returns half a texel along u and v, metres (orthographic) or tangents.
glm::dvec2 half_texel(const ShadowView& view, std::uint32_t size_px) {
    if (!is_parallel(view)) return (view.plane.tan_high - view.plane.tan_low) * (0.5 / size_px);
    return {1.0 / (size_px * glm::length(row(view.clip_from_anchor, 0))),
            1.0 / (size_px * glm::length(row(view.clip_from_anchor, 1)))};
}

/// Returns the least factor by which the instance scales a length. The smallest singular value is at least the
/// determinant over the sum of squares of the columns, which bounds the product of the others.
double least_stretch(const InstanceItem& item) {
    const glm::dmat3& m = item.basis;
    const double squares = glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]);
    return std::abs(glm::determinant(m)) / squares;
}

}  // namespace

BoundsFloor bounds_floor(const ShadowView& view, std::uint32_t size_px) {
    const glm::dvec2 half = half_texel(view, size_px);
    if (!is_parallel(view)) return {0.0, 0.0f, kFloorTangent * std::max(half.x, half.y)};
    if (view.plane.warp != glm::dvec2(0.0)) return {};
    const double departure = kFloorTangent * std::max(half.x, half.y) * glm::length(row(view.clip_from_anchor, 2));
    return {departure, static_cast<float>(kDepartureFactor * departure + kFlatRounding), 0.0};
}

FlatFacetTest::FlatFacetTest(const CasterTopology& surface, const InstanceItem& item, const ShadowView& view,
                             std::uint32_t size_px)
    : floor_(bounds_floor(view, size_px)),
      parallel_(is_parallel(view)),
      half_texel_(half_texel(view, size_px)),
      least_stretch_(least_stretch(item)) {
    const ClipRounding rounding(surface, item, view);
    if (parallel_) {
        const double across_texel = std::max(rounding.of_row(0), rounding.of_row(1)) * 0.5 * size_px;
        possible_ = floor_.departure > 0.0 && across_texel <= kMostMoved_texel && rounding.of_row(2) <= kFlatRounding;
        depth_per_m_ = glm::length(row(view.clip_from_anchor, 2));
        least_cosine_ = 1.0 / std::sqrt(1.0 + kFloorTangent * kFloorTangent);
        return;
    }
    possible_ = true;
    off_m_ = rounding.length_m();
    // |n_u| + |n_v| <= t (n · d) with d = (u, v, 1). So least_cosine_ bounds n · d from below, and widest_ bounds |d|²
    // from above.
    const glm::dvec2 widest = glm::max(glm::abs(view.plane.tan_low), glm::abs(view.plane.tan_high));
    const double most = std::max(widest.x, widest.y);
    const double t = kFloorTangent * std::max(half_texel_.x, half_texel_.y) / std::min(half_texel_.x, half_texel_.y);
    least_cosine_ = 1.0 / std::hypot(t, 1.0 + t * most);
    widest_ = 1.0 + glm::dot(widest, widest);
}

bool FlatFacetTest::orthographic(const CasterTopology::Facet& facet, const glm::dvec3& normal_vs) const {
    const glm::dvec3 n = glm::abs(normal_vs);
    const double across = n.x * half_texel_.x + n.y * half_texel_.y;
    const double least_texels = least_stretch_ * least_cosine_ / (2.0 * std::max(half_texel_.x, half_texel_.y));
    return static_cast<double>(facet.altitude_ms) * least_texels >= kLeastAltitude_texel &&
           across * depth_per_m_ * (1.0 + kFacingUnits * kUnitRoundoff) < floor_.departure * n.z;
}

/// Tests a facet in perspective. Over a plane, 1/z is n · (u, v, 1) over the light's height above it. `steepest`:
/// change of 1/z over half a texel, as a share of its smallest value on the facet. Corners may be off by the same share
/// of their distance, which is at least the height over |(u, v, 1)|.
bool FlatFacetTest::perspective(const CasterTopology::Facet& facet, const glm::dvec3& normal_vs, double height,
                                double farthest_m) const {
    const double steepest = (std::abs(normal_vs.x) * half_texel_.x + std::abs(normal_vs.y) * half_texel_.y) *
                            farthest_m * (1.0 + kFacingUnits * kUnitRoundoff) / height;
    const double off = off_m_ * glm::length(normal_vs) * std::sqrt(widest_) / height;
    const double least_texels =
        least_stretch_ * least_cosine_ / (farthest_m * widest_ * 2.0 * std::max(half_texel_.x, half_texel_.y));
    return steepest + 2.0 * off <= floor_.share &&
           off <= kMostMoved_texel * 2.0 * std::min(half_texel_.x, half_texel_.y) &&
           static_cast<double>(facet.altitude_ms) * least_texels >= kLeastAltitude_texel;
}

bool FlatFacetTest::operator()(const CasterTopology::Facet& facet, const glm::dvec3& normal_vs, double height,
                               double error, double farthest_m) const {
    if (!possible_ || !(std::abs(height) > error)) return false;
    return parallel_ ? orthographic(facet, normal_vs)
                     : perspective(facet, normal_vs, std::abs(height) - error, farthest_m);
}

}  // namespace gnomon::shadow
