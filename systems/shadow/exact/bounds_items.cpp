#include "systems/shadow/exact/bounds_items.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <iterator>

#include "systems/shadow/exact/clip_error.h"
#include "systems/shadow/exact/error_margins.h"

namespace gnomon::shadow {
namespace {

constexpr double kDoubleRoundoff = 1.1102230246251565e-16;
/// Error of places in double, units of rounding.
constexpr double kPlaceUnits = 16.0;
/// Least w of a vertex that counts as in front of the light, in its own errors. Shaders take more than 16.
constexpr double kBeforeLight = 32.0;

/// Returns the matrix that turns normals of planes as `m` turns points, up to a factor. Needs no inverse.
glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

/// Test on which side of a facet's plane the light is. Results carry a factor common to all facets of an instance.
class FacingTest {
public:
    FacingTest(const InstanceItem& item, const ShadowView& view) : parallel_(is_parallel(view)) {
        const glm::dmat3 turned = cofactors(item.basis);
        from_model_ = glm::transpose(glm::dmat3(view.pose.axis_u, view.pose.axis_v, view.pose.axis_back)) * turned;
        scale_ = glm::dot(item.basis[0], turned[0]);
        if (parallel_) {
            toward_ms_ = glm::transpose(turned) * view.pose.axis_back;
        } else {
            toward_ms_ = glm::transpose(turned) * (view.pose.anchor_ws_m - item.translation_ws_m);
            rounding_ = kPlaceUnits * kDoubleRoundoff *
                        glm::length(absolute(glm::transpose(turned),
                                             glm::abs(view.pose.anchor_ws_m) + glm::abs(item.translation_ws_m)));
        }
    }

    /// Returns the side: positive where the facet's outside faces the light. In perspective it is the light's height
    /// above the plane, times the factor. `error`: bound on how far it is off.
    double operator()(const CasterTopology::Facet& facet, double& error) const {
        const glm::dvec3 toward = parallel_ ? toward_ms_ : toward_ms_ - scale_ * glm::dvec3(facet.corner_ms);
        error = kFacingUnits * kUnitRoundoff * glm::length(toward) + rounding_;
        return glm::dot(glm::dvec3(facet.normal_ms), toward);
    }
    /// Returns the facet's normal along the view's axes, times the same factor.
    glm::dvec3 in_view(const CasterTopology::Facet& facet) const { return from_model_ * glm::dvec3(facet.normal_ms); }

private:
    bool parallel_;
    glm::dmat3 from_model_{1.0};
    glm::dvec3 toward_ms_{0.0};
    double scale_ = 1.0, rounding_ = 0.0;
};

bool is_contour(const assets::SurfaceEdges::Fold& fold, const std::vector<std::int8_t>& facing) {
    const int other = fold.same_way ? -facing[fold.second] : facing[fold.second];
    return facing[fold.first] * other <= 0;
}

}  // namespace

/// Projects the vertices into the map. Bits of `beyond` allow for float's rounding and for the reach of quads. Each bit
/// is one side of the map, except that for `behind`.
void BoundsGatherer::place(const std::vector<assets::Vertex>& vertices, const CasterTopology& surface,
                           const InstanceItem& item, const ShadowView& view, std::uint32_t size_px) {
    const glm::dmat4 clip_from_anchor(view.clip_from_anchor);
    glm::dmat4 anchor_from_model(item.basis);
    anchor_from_model[3] = glm::dvec4(item.translation_ws_m - view.pose.anchor_ws_m, 1.0);
    const glm::dmat4 clip_from_model = clip_from_anchor * anchor_from_model;
    const ClipRounding rounding(surface, item, view);
    const double beyond = 1.0 + kQuadReach_texel * 2.0 / size_px, w_slack = rounding.of_row(3);
    const glm::dvec2 slack(rounding.of_row(0) + beyond * w_slack, rounding.of_row(1) + beyond * w_slack);
    const double half_size = 0.5 * size_px, row_slack = std::max(rounding.of_row(0), rounding.of_row(1));
    placed_.resize(vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        const glm::dvec4 c = clip_from_model * glm::dvec4(glm::dvec3(vertices[v].position_ms), 1.0);
        const double reach = beyond * c.w;
        const bool bits[] = {c.x > reach + slack.x, -c.x > reach + slack.x, c.y > reach + slack.y,
                             -c.y > reach + slack.y, c.w < -w_slack};
        Placed& placed = placed_[v] = {.distance_m = c.w};
        if (c.w > kBeforeLight * w_slack && c.w > 0.0) {
            const glm::dvec2 map = glm::dvec2(c) / c.w;
            const double moved = (row_slack + std::max(std::abs(map.x), std::abs(map.y)) * w_slack) / c.w;
            placed.is_placed = moved * half_size <= kSmallMoved_texel;
            placed.at_texel = glm::vec2(map * half_size + half_size);
        }
        for (unsigned bit = 0; bit < std::size(bits); ++bit)
            placed.beyond = static_cast<std::uint8_t>(placed.beyond | (bits[bit] ? 1u << bit : 0u));
    }
}

bool BoundsGatherer::is_small(const Placed& a, const Placed& b, const Placed& c) const {
    if (!draws_points_ || !a.is_placed || !b.is_placed || !c.is_placed) return false;
    const glm::vec2 size =
        glm::max(a.at_texel, glm::max(b.at_texel, c.at_texel)) - glm::min(a.at_texel, glm::min(b.at_texel, c.at_texel));
    return std::max(size.x, size.y) <= static_cast<float>(kSmall_texel);
}

void BoundsGatherer::append(const GpuScene& gpu, const CasterTopology& surface, const InstanceItem& item,
                            const ShadowView& view, std::uint32_t size_px, BoundsItems& items) {
    const GpuScene::MeshShape shape = gpu.shape(item.mesh);
    const auto& indices = *shape.indices;
    const auto base = static_cast<std::uint32_t>(gpu.mesh(item.mesh).base_vertex);
    place(*shape.vertices, surface, item, view, size_px);
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, BoundsItems::Kind kind) {
        const Placed &one = placed_[a], &two = placed_[b], &three = placed_[c];
        if ((one.beyond & two.beyond & three.beyond) != 0) return;
        std::vector<BoundsItem>& to = (is_small(one, two, three) ? items.small : items.large)[kind];
        to.push_back({item.gpu_slot, base + a, base + b, base + c});
    };
    const auto add_triangle = [&](std::uint32_t t, BoundsItems::Kind kind) {
        add(indices[std::size_t{3} * t], indices[std::size_t{3} * t + 1], indices[std::size_t{3} * t + 2], kind);
    };
    const auto farthest_m = [&](std::uint32_t t) {
        const auto distance = [&](std::size_t corner) {
            return placed_[indices[std::size_t{3} * t + corner]].distance_m;
        };
        return std::max({distance(0), distance(1), distance(2)});
    };
    const FacingTest test(item, view);
    const FlatFacetTest is_flat(surface, item, view, size_px);
    facing_.resize(surface.facets.size());
    for (const std::uint32_t t : surface.opaque) {
        const CasterTopology::Facet& facet = surface.facets[t];
        double error = 0.0;
        const double side = test(facet, error);
        facing_[t] = side > error ? 1 : (side < -error ? -1 : 0);
        if (!is_flat(facet, test.in_view(facet), side, error, farthest_m(t))) add_triangle(t, BoundsItems::triangles);
    }
    for (const auto& border : surface.edges.borders) add(border.a, border.b, border.a, BoundsItems::contours);
    for (const auto& fold : surface.edges.folds)
        if (is_contour(fold, facing_)) add(fold.a, fold.b, fold.a, BoundsItems::contours);
    for (const std::uint32_t t : surface.masked) add_triangle(t, BoundsItems::masked);
}

}  // namespace gnomon::shadow
