#include "systems/shadow/culling/view_casters.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <span>

#include "engine/math/convex_polygon.h"
#include "systems/extract/scene_tree.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/culling/receiver_hull.h"
#include "systems/shadow/culling/receiver_mask.h"
#include "systems/shadow/culling/static_dynamic_casters.h"
#include "systems/shadow/culling/swept_volume.h"
#include "systems/shadow/projection/lispsm_math.h"

namespace gnomon::shadow {
namespace {

/// Length of edges to drop, in slacks of a receiver hull. A polygon widened by two slacks has edges of up to 4 √2 at
/// its corners.
constexpr double kOutlineSlacks = 8.0;

glm::dmat3 axes_of(const ShadowView& view) { return {view.pose.axis_u, view.pose.axis_v, view.pose.axis_back}; }

void assign_rectangle(const glm::dvec2& low, const glm::dvec2& high, std::vector<glm::dvec2>& polygon) {
    polygon.assign({low, {high.x, low.y}, high, {low.x, high.y}});
}

/// Returns the light frustum of a perspective view's map from its matrix: u/z = low.x maps to x/w = -1, and so on.
LightFrustum frustum_of(const ShadowView& view) {
    const auto row = [&](int r) {
        return glm::dvec3(view.clip_from_anchor[0][r], view.clip_from_anchor[1][r], view.clip_from_anchor[2][r]);
    };
    const double depth = -glm::dot(row(3), view.pose.axis_back);  // w is the distance along the axis, times this
    const glm::dvec2 scale(glm::dot(row(0), view.pose.axis_u) / depth, glm::dot(row(1), view.pose.axis_v) / depth);
    const glm::dvec2 shift(-glm::dot(row(0), view.pose.axis_back) / depth,
                           -glm::dot(row(1), view.pose.axis_back) / depth);
    return {axes_of(view), (glm::dvec2(-1.0) - shift) / scale, (glm::dvec2(1.0) - shift) / scale, view.layer, 0};
}

class ViewSearch {
public:
    ViewSearch(const SceneSnapshot& scene, const CasterInputs& inputs, const ShadowView& view, SetScratch& scratch)
        : scene_(scene), light_(scene.lights[view.light]), view_(view), sets_(inputs.sets), scratch_(scratch) {
        // A tap reaches E texels from its point, which may lie anywhere in its texel.
        const double reach = std::ceil(static_cast<double>(inputs.filter.widest_texel)) + 1.0;
        reach_ = reach * glm::dvec2(view.plane.texel_u, view.plane.texel_v);
        masks_ = inputs.seen && !view.stays && is_parallel(view) && view.plane.warp == glm::dvec2(0.0);
        if (masks_) build_receiver_mask(scene, *inputs.seen, view, reach_, scratch.mask);
    }

    void run() {
        scratch_.marks.clear(scene_.instances.size());
        if (is_parallel(view_))
            look_along();
        else
            look_through();
    }

private:
    /// Marks the casters between the light and scratch_.polygon, which has the coordinates of `receiver_hull`.
    void mark_casters(const ReceiverHull& receiver_hull, double reach_m) {
        if (scratch_.polygon.empty()) return;
        const auto seen =
            view_.stays ? std::span<const math::Plane>() : seen_by_the_only_consumer(sets_.arrays.camera_frusta);
        const SweptVolume volume = swept_volume(receiver_hull, scratch_.polygon, seen, reach_m);
        const auto classify = [&](const math::Aabb& box, math::OpenTests& open) {
            const math::Overlap of_volume = overlap(volume, box, open);
            if (!masks_ || of_volume == math::Overlap::outside) return of_volume;
            return covers(scratch_.mask, box) ? math::Overlap::partial : math::Overlap::outside;
        };
        visit_instances(scene_, tests_of(volume), classify, [&](std::uint32_t i) {
            if (scratch_.layers->casts_under(light_, i)) scratch_.marks.add(i);
        });
    }

    /// Transforms scratch_.polygon into the warped plane. Clips parts with a smaller w than any point of the map.
    /// Returns the polygon's largest w.
    double warp_polygon() {
        const double nearest = glm::dot(view_.plane.warp, view_.plane.centre_ls_m) -
                               glm::dot(glm::abs(view_.plane.warp), view_.plane.half_extent_m + reach_);
        math::clip_polygon(view_.plane.warp, 1.0 - 1.0 / (1.0 - nearest), scratch_.polygon, scratch_.clipped);
        double largest_w = 1.0;
        for (glm::dvec2& p : scratch_.polygon) {
            largest_w = std::max(largest_w, warp_w(view_.plane.warp, p));
            p = warped(view_.plane.warp, p);
        }
        return largest_w;
    }

    /// Transforms scratch_.polygon back. Clips parts with more than twice the receivers' largest w, because the map's
    /// corners may be at infinity. Returns the filter's radius, metres.
    double unwarp_polygon(double farthest_w) {
        math::clip_polygon(-view_.plane.warp, 1.0 - 0.5 / farthest_w, scratch_.polygon, scratch_.clipped);
        double reach_m = 0.0;
        for (glm::dvec2& q : scratch_.polygon) {
            q = unwarped(view_.plane.warp, q);
            for (const glm::dvec2& step : {reach_, glm::dvec2(reach_.x, -reach_.y)})
                reach_m = std::max(reach_m, glm::length(unwarped_step(view_.plane.warp, q, step)));
        }
        return reach_m;
    }

    /// Marks the casters of a cascade: between the light and the receiver hull within the map's rectangle.
    void look_along() {
        ReceiverHull receiver_hull = sets_.hulls().front();
        const bool warps = view_.plane.warp != glm::dvec2(0.0);
        const glm::dvec2 origin_m = warps ? glm::dvec2(0.0) : view_.plane.centre_ls_m,
                         centre_m = view_.plane.centre_ls_m - origin_m;
        const glm::dvec3 origin_ws_m =
            view_.pose.anchor_ws_m + view_.pose.axis_u * origin_m.x + view_.pose.axis_v * origin_m.y;
        double reach_m = reach_.x + reach_.y;
        const glm::dvec3 offset = receiver_hull.origin_ws_m - origin_ws_m;
        const double far_m = view_.depth.far_m + glm::dot(view_.pose.axis_back, origin_ws_m - view_.pose.anchor_ws_m);
        if (view_.stays) {
            assign_rectangle(-view_.plane.half_extent_m, view_.plane.half_extent_m, scratch_.polygon);
            receiver_hull.far_m = far_m;
        } else {
            scratch_.polygon.clear();
            for (const glm::dvec2& p : sets_.outline(receiver_hull)) {
                const glm::dvec3 at = offset + receiver_hull.axes[0] * p.x + receiver_hull.axes[1] * p.y;
                scratch_.polygon.emplace_back(glm::dot(at, view_.pose.axis_u), glm::dot(at, view_.pose.axis_v));
            }
            const double farthest_w = warps ? warp_polygon() : 1.0;
            // In rotated axes the hull's own widening (two slacks) is a chamfer of any direction. Dropping it is undone
            // by widening: for receivers edge-on to the sun the chamfer may be larger than their whole map.
            const double dropped_m = kOutlineSlacks * receiver_hull.slack;
            math::drop_flat_corners(dropped_m, scratch_.polygon, scratch_.clipped);
            widen(scratch_.polygon, reach_ + dropped_m, scratch_);
            const glm::dvec2 half = view_.plane.half_extent_m + receiver_hull.slack;
            math::clip_polygon({1, 0}, half.x - centre_m.x, scratch_.polygon, scratch_.clipped);
            math::clip_polygon({-1, 0}, half.x + centre_m.x, scratch_.polygon, scratch_.clipped);
            math::clip_polygon({0, 1}, half.y - centre_m.y, scratch_.polygon, scratch_.clipped);
            math::clip_polygon({0, -1}, half.y + centre_m.y, scratch_.polygon, scratch_.clipped);
            if (warps) reach_m = unwarp_polygon(farthest_w);
            receiver_hull.far_m = std::min(far_m, receiver_hull.far_m - glm::dot(offset, view_.pose.axis_back));
        }
        receiver_hull.origin_ws_m = origin_ws_m;
        receiver_hull.axes = axes_of(view_);
        mark_casters(receiver_hull, reach_m);
    }

    /// Marks the casters of a spot's view, a cube face or a sun's view from an eye.
    void look_through() {
        const LightFrustum frustum = frustum_of(view_);
        ReceiverHull receiver_hull;
        const auto hulls = sets_.hulls();
        const auto same = std::find_if(hulls.begin(), hulls.end(), [&](const ReceiverHull& b) {
            return !b.parallel && b.origin_ws_m == apex_ws_m(view_) && b.axes == frustum.axes;
        });
        if (view_.stays) {
            receiver_hull.origin_ws_m = apex_ws_m(view_);
            receiver_hull.axes = frustum.axes;
            receiver_hull.far_m = view_.depth.far_m;
            receiver_hull.reach_m = std::numeric_limits<double>::infinity();
            assign_rectangle(frustum.low, frustum.high, scratch_.polygon);
        } else if (same != hulls.end()) {
            receiver_hull = *same;
            const auto outline = sets_.outline(receiver_hull);
            scratch_.polygon.assign(outline.begin(), outline.end());
        } else {
            receiver_hull = hull_through(frustum);
        }
        if (scratch_.polygon.empty()) return;
        widen(scratch_.polygon, reach_, scratch_);
        receiver_hull.far_m = std::min(receiver_hull.far_m, view_.depth.far_m);
        const double reach_m = (reach_.x + reach_.y) * receiver_hull.far_m;
        receiver_hull.reach_m += reach_m;
        mark_casters(receiver_hull, reach_m);
    }

    /// Computes the receiver hull of a light frustum that the sets do not contain, by clipping the receivers again.
    ReceiverHull hull_through(const LightFrustum& frustum) {
        const auto sides = frustum_planes(apex_ws_m(view_), frustum);
        scratch_.points_ws.clear();
        std::array<math::Plane, math::kMaxClipPlanes> planes;
        for (const math::Frustum& camera : sets_.arrays.camera_frusta) {
            const auto seen = math::planes_of(camera);
            const auto end = std::copy(sides.begin(), sides.end(), std::copy(seen.begin(), seen.end(), planes.begin()));
            const auto used = std::span(planes).first(static_cast<std::size_t>(end - planes.begin()));
            for (const std::uint32_t i : sets_.receivers())
                math::clip_box(used, scene_.instances[i].bounds_ws, scratch_.points_ws);
        }
        scratch_.polygon.clear();
        if (scratch_.points_ws.empty()) return {};
        scratch_.outline.clear();
        ReceiverHull receiver_hull =
            frustum_hull(apex_ws_m(view_), frustum, scratch_.points_ws, scratch_.outline, scratch_);
        scratch_.polygon.assign(scratch_.outline.begin(), scratch_.outline.end());
        return receiver_hull;
    }

    const SceneSnapshot& scene_;
    const LightItem& light_;
    const ShadowView& view_;
    const LightSetsView& sets_;
    SetScratch& scratch_;
    glm::dvec2 reach_{0.0};  // radius of the filter, metres or tangents
    bool masks_ = false;     // scratch_.mask has the receivers that are seen
};

/// Appends the marked instances by mesh, then by index, because one draw per mesh needs equal meshes side by side.
/// Counting sort in linear time; a comparison sort where there are more meshes than instances.
void append_by_mesh(const SceneSnapshot& scene, SetScratch& scratch, std::vector<std::uint32_t>& out) {
    scratch.items.clear();
    std::uint32_t meshes = 0;
    scratch.marks.for_each([&](std::uint32_t i) {
        scratch.items.push_back(i);
        meshes = std::max(meshes, scene.instances[i].mesh + 1);
    });
    const std::size_t first = out.size();
    out.insert(out.end(), scratch.items.begin(), scratch.items.end());
    if (meshes > scratch.items.size()) {
        std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(), [&](std::uint32_t a, std::uint32_t b) {
            const std::uint32_t mesh_a = scene.instances[a].mesh, mesh_b = scene.instances[b].mesh;
            return mesh_a != mesh_b ? mesh_a < mesh_b : a < b;
        });
        return;
    }
    scratch.mesh_starts.assign(meshes + std::size_t{1}, 0);
    for (const std::uint32_t i : scratch.items) ++scratch.mesh_starts[scene.instances[i].mesh + std::size_t{1}];
    for (std::size_t m = 1; m < scratch.mesh_starts.size(); ++m) scratch.mesh_starts[m] += scratch.mesh_starts[m - 1];
    for (const std::uint32_t i : scratch.items) out[first + scratch.mesh_starts[scene.instances[i].mesh]++] = i;
}

/// Moves dynamic casters to the end, and keeps the order otherwise. Returns the number of static casters.
std::uint32_t partition_dynamic_last(const SceneSnapshot& scene, std::span<const std::uint64_t> moving,
                                     std::span<std::uint32_t> casters, std::vector<std::uint32_t>& movers) {
    if (moving.empty()) return static_cast<std::uint32_t>(casters.size());
    movers.clear();
    std::size_t still = 0;
    for (const std::uint32_t i : casters) {
        if (moves(moving, scene.instances[i]))
            movers.push_back(i);
        else
            casters[still++] = i;
    }
    std::copy(movers.begin(), movers.end(), casters.begin() + static_cast<std::ptrdiff_t>(still));
    return static_cast<std::uint32_t>(still);
}

}  // namespace

void select_view_casters(const SceneSnapshot& scene, const CasterInputs& inputs, ShadowView& view, SetScratch& scratch,
                         std::vector<std::uint32_t>& casters) {
    ViewSearch(scene, inputs, view, scratch).run();
    view.casters.first = static_cast<std::uint32_t>(casters.size());
    append_by_mesh(scene, scratch, casters);
    view.casters.count = static_cast<std::uint32_t>(casters.size()) - view.casters.first;
    view.static_casters =
        partition_dynamic_last(scene, inputs.moving, std::span(casters).subspan(view.casters.first), scratch.items);
}

}  // namespace gnomon::shadow
