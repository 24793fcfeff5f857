#include "systems/shadow/fit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/math/frustum.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/filter_table.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/light_time.h"

namespace gnomon::shadow {
namespace {

/// Whether a caster can darken anything within one cascade's map: it overlaps the map's rectangle and is not
/// wholly behind the far plane. Nearer than the near plane it still counts.
bool before_rectangle(const ShadowView& view, const math::Aabb& box_ws) {
    const glm::dvec3 centre = math::centre(box_ws) - view.anchor_ws_m, half = math::half_extent(box_ws);
    const auto reach = [&](const glm::dvec3& axis) { return glm::dot(half, glm::abs(axis)); };
    return std::abs(glm::dot(centre, view.axis_u) - view.centre_ls_m.x) <= view.half_extent_m.x + reach(view.axis_u) &&
           std::abs(glm::dot(centre, view.axis_v) - view.centre_ls_m.y) <= view.half_extent_m.y + reach(view.axis_v) &&
           -glm::dot(centre, view.axis_back) - reach(view.axis_back) <= view.far_m;
}

/// Casters of a view: those of the light that can show in it.
void assign_casters(const SceneSnapshot& scene, const PotentialSets& sets, ShadowView& view, ShadowFrame& frame) {
    view.casters.first = static_cast<std::uint32_t>(frame.view_caster_items.size());
    const math::Frustum face =
        view.projection == ViewProjection::cube_face
            ? pyramid(view.anchor_ws_m, glm::dmat3(view.axis_u, view.axis_v, view.axis_back), 1.0, view.far_m)
            : math::Frustum{};
    for (std::uint32_t i = 0; i < sets.casters.count; ++i) {
        const std::uint32_t item = frame.caster_items[sets.casters.first + i];
        const math::Aabb& box_ws = scene.instances[item].bounds_ws;
        const bool shows = view.projection == ViewProjection::orthographic ? before_rectangle(view, box_ws)
                                                                           : math::may_overlap(face, box_ws);
        if (shows) frame.view_caster_items.push_back(item);
    }
    // One draw per mesh needs equal meshes side by side; entity order within.
    const auto begin = frame.view_caster_items.begin() + view.casters.first;
    std::sort(begin, frame.view_caster_items.end(), [&scene](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t mesh_a = scene.instances[a].mesh, mesh_b = scene.instances[b].mesh;
        return mesh_a != mesh_b ? mesh_a < mesh_b : a < b;
    });
    view.casters.count = static_cast<std::uint32_t>(frame.view_caster_items.size()) - view.casters.first;
}

}  // namespace

double predict_error_px(const ShadowView& view, const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws) {
    constexpr double kOneTapShare = 0.71, kPixelCentre_px = 0.5;
    const double footprint = pixel_footprint(consumer);
    const bool perspective_camera = consumer.projection == CameraProjection::perspective;
    const double texel = std::hypot(view.texel_u, view.texel_v);
    double worst_px = 0.0;
    for (const glm::dvec3& p : points_ws) {
        const double depth_m = -glm::dot(p - consumer.position_ws_m, consumer.rotation_ws[2]);
        if (!(depth_m > 0.0)) continue;
        const double pixel_m =
            perspective_camera ? footprint * std::max({depth_m, consumer.near_m, view.seen_from_m}) : footprint;
        const double texel_m =
            view.projection == ViewProjection::orthographic ? texel : texel * glm::distance(p, view.anchor_ws_m);
        worst_px = std::max(worst_px, kOneTapShare * texel_m / pixel_m + kPixelCentre_px);
    }
    return worst_px;
}

void fit_views(const SceneSnapshot& scene, const History& held, ShadowFrame& frame) {
    const HeldLight none;
    frame.views.clear();
    frame.next_history.lights.clear();
    frame.view_caster_items.clear();
    for (std::uint32_t d = 0; d < frame.demands.size(); ++d) {
        PotentialSets& sets = frame.sets[d];
        const ShadowDemand& demand = frame.demands[d];
        if (demand.skip != Reason::none) continue;
        const LightTime time(frame, demand.light);
        const LightItem& light = scene.lights[demand.light];
        const HeldLight* last = find(held, light.entity, frame.next_history.lights.size());
        HeldLight& next = frame.next_history.lights.emplace_back(last ? *last : none);
        next.light = light.entity;
        if (sets.skip != Reason::none) continue;
        const auto points =
            std::span(frame.receiver_points_ws).subspan(sets.receiver_points.first, sets.receiver_points.count);
        const FitInput input{light,
                             demand,
                             scene,
                             std::span(frame.receiver_items).subspan(sets.receivers.first, sets.receivers.count),
                             std::span(frame.caster_items).subspan(sets.casters.first, sets.casters.count),
                             points,
                             filter_row(demand.filter).reach_texel,
                             frame.fit_scratch,
                             last ? *last : none,
                             next};
        const std::size_t first = frame.views.size();
        if (!light_kind_row(light.kind).fit(input, frame.views)) {
            frame.views.resize(first);
            sets.skip = Reason::fit_degenerate;
            continue;
        }
        for (std::size_t v = first; v < frame.views.size(); ++v) {
            ShadowView& view = frame.views[v];
            view.demand = d;
            assign_casters(scene, sets, view, frame);
            for (std::uint32_t c = 0; c < scene.consumers.size(); ++c) {
                view.consumer_mask |= 1u << c;
                view.predicted_error_px =
                    std::max(view.predicted_error_px, predict_error_px(view, scene.consumers[c], points));
            }
        }
    }
}

}  // namespace gnomon::shadow
