#include "systems/shadow/exact/sheet_items.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "systems/shadow/exact/sheet_margins.h"

namespace gnomon::shadow {
namespace {

constexpr double kUnitRoundoff = 5.9604644775390625e-8;  // of float, 2^-24
constexpr double kDoubleRoundoff = 1.1102230246251565e-16;
/// Of a facet's normal, rounded to float, with the products and sums of its test; and the same of places in double.
constexpr double kFacingUnits = 4.0, kPlaceUnits = 16.0;
/// Tangent between normal and light up to which a facet is not drawn (SheetFloor).
constexpr double kFloorTangent = 4.0;

bool is_parallel(const ShadowView& view) { return view.projection == ViewProjection::orthographic; }
bool is_plain(const ShadowView& view) { return is_parallel(view) && view.warp == glm::dvec2(0.0); }

/// Turns normals of planes as `m` turns points, but for a factor; needs no inverse.
glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

glm::dvec3 absolute(const glm::dmat3& m, const glm::dvec3& v) {
    return glm::abs(m[0]) * v.x + glm::abs(m[1]) * v.y + glm::abs(m[2]) * v.z;
}

glm::dvec3 row(const glm::mat4& m, int r) { return {m[0][r], m[1][r], m[2][r]}; }

/// On which side of a facet's plane the light is, times a factor common to all facets of an instance.
class FacingTest {
public:
    FacingTest(const InstanceItem& item, const ShadowView& view) : parallel_(is_parallel(view)) {
        const glm::dmat3 turned = cofactors(item.basis);
        from_model_ = glm::transpose(glm::dmat3(view.axis_u, view.axis_v, view.axis_back)) * turned;
        scale_ = glm::dot(item.basis[0], turned[0]);
        if (parallel_) {
            toward_ms_ = glm::transpose(turned) * view.axis_back;
        } else {
            toward_ms_ = glm::transpose(turned) * (view.anchor_ws_m - item.translation_ws_m);
            rounding_ = kPlaceUnits * kDoubleRoundoff *
                        glm::length(absolute(glm::transpose(turned),
                                             glm::abs(view.anchor_ws_m) + glm::abs(item.translation_ws_m)));
        }
    }

    /// Along which lies its outside, from the facet.
    double operator()(const CasterSurface::Facet& facet, double& error) const {
        const glm::dvec3 toward = parallel_ ? toward_ms_ : toward_ms_ - scale_ * glm::dvec3(facet.corner_ms);
        error = kFacingUnits * kUnitRoundoff * glm::length(toward) + rounding_;
        return glm::dot(glm::dvec3(facet.normal_ms), toward);
    }
    /// Its normal in the view's axes, times the same factor.
    glm::dvec3 in_view(const CasterSurface::Facet& facet) const { return from_model_ * glm::dvec3(facet.normal_ms); }

private:
    bool parallel_;
    glm::dmat3 from_model_{1.0};
    glm::dvec3 toward_ms_{0.0};
    double scale_ = 1.0, rounding_ = 0.0;
};

/// Whether what float does to the instance's vertices stays within what flat facets are given (kFlatRounding).
bool is_placed_finely(const CasterSurface& surface, const InstanceItem& item, const ShadowView& view,
                      std::uint32_t size_px) {
    const glm::dvec3 local = absolute(item.basis, surface.reach_ms);
    const glm::dvec3 reach = local + glm::abs(item.translation_ws_m - view.anchor_ws_m);
    const double split = kSplitUnits * glm::length(item.translation_ws_m) + kSplitUnits * glm::length(view.anchor_ws_m);
    const glm::dvec3 error = (kPlacedUnits + kProjectedUnits) * kUnitRoundoff * reach + split;
    const auto of_row = [&](int r) {
        return glm::dot(glm::abs(row(view.clip_from_anchor, r)), error) +
               kProjectedUnits * kUnitRoundoff * std::abs(static_cast<double>(view.clip_from_anchor[3][r]));
    };
    const double across_texel = std::max(of_row(0), of_row(1)) * 0.5 * size_px;
    return across_texel <= kMostMoved_texel && of_row(2) <= kFlatRounding;
}

/// Of a length in the model at least so much is left in the map, in texels, of facets that the light meets no more
/// obliquely than flat ones: the smallest singular value is no less than the determinant over the squares of the
/// others.
double least_texels_per_ms(const InstanceItem& item, double texel_m) {
    const glm::dmat3& m = item.basis;
    const double squares = glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]);
    const double stretch = std::abs(glm::determinant(m)) / squares;
    return stretch / (texel_m * std::sqrt(1.0 + kFloorTangent * kFloorTangent));
}

bool is_contour(const assets::SurfaceEdges::Fold& fold, const std::vector<std::int8_t>& facing) {
    const int other = fold.same_way ? -facing[fold.second] : facing[fold.second];
    return facing[fold.first] * other <= 0;
}

}  // namespace

SheetFloor sheet_floor(const ShadowView& view, std::uint32_t size_px) {
    if (!is_plain(view)) return {};
    const double texel_m = 2.0 / (size_px * std::min(glm::length(row(view.clip_from_anchor, 0)),
                                                     glm::length(row(view.clip_from_anchor, 1))));
    const double departure = 0.5 * kFloorTangent * texel_m * glm::length(row(view.clip_from_anchor, 2));
    return {departure, static_cast<float>(kDepartureFactor * departure + kFlatRounding)};
}

void SheetGatherer::append(const GpuScene& gpu, const CasterSurface& surface, const InstanceItem& item,
                           const ShadowView& view, std::uint32_t size_px, SheetItems& items) {
    const auto& indices = *gpu.shape(item.mesh).indices;
    const auto base = static_cast<std::uint32_t>(gpu.mesh(item.mesh).base_vertex);
    const auto triangle = [&](std::uint32_t t) {
        return SheetItem{item.gpu_slot, base + indices[std::size_t{3} * t], base + indices[std::size_t{3} * t + 1],
                         base + indices[std::size_t{3} * t + 2]};
    };
    const FacingTest test(item, view);
    const SheetFloor floor = sheet_floor(view, size_px);
    const bool skips = floor.departure > 0.0 && is_placed_finely(surface, item, view, size_px);
    // Half a texel along u and v, and what depth changes by per metre along the light.
    const glm::dvec2 half_texel_m(1.0 / (size_px * glm::length(row(view.clip_from_anchor, 0))),
                                  1.0 / (size_px * glm::length(row(view.clip_from_anchor, 1))));
    const double least_texels = least_texels_per_ms(item, 2.0 * std::max(half_texel_m.x, half_texel_m.y));
    const double depth_per_m = glm::length(row(view.clip_from_anchor, 2));
    facing_.resize(surface.facets.size());
    for (const std::uint32_t t : surface.opaque) {
        double error = 0.0;
        const double side = test(surface.facets[t], error);
        facing_[t] = side > error ? 1 : (side < -error ? -1 : 0);
        const bool is_wide = static_cast<double>(surface.facets[t].altitude_ms) * least_texels >= kLeastAltitude_texel;
        if (skips && is_wide && facing_[t] != 0) {
            const glm::dvec3 n = glm::abs(test.in_view(surface.facets[t]));
            const double across = n.x * half_texel_m.x + n.y * half_texel_m.y;
            if (across * depth_per_m * (1.0 + kFacingUnits * kUnitRoundoff) < floor.departure * n.z) continue;
        }
        items.triangles.push_back(triangle(t));
    }
    const auto edge = [&](std::uint32_t a, std::uint32_t b) {
        items.contours.push_back({item.gpu_slot, base + a, base + b, base + a});
    };
    for (const auto& border : surface.edges.borders) edge(border.a, border.b);
    for (const auto& fold : surface.edges.folds)
        if (is_contour(fold, facing_)) edge(fold.a, fold.b);
    for (const std::uint32_t t : surface.masked) items.masked.push_back(triangle(t));
}

}  // namespace gnomon::shadow
