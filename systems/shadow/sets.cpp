#include "systems/shadow/sets.h"

#include <cmath>
#include <limits>

#include "engine/math/frustum.h"
#include "systems/extract/volumes.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/light_time.h"

namespace gnomon::shadow {
namespace {

/// What a light can reach, tested on boxes.
class Reach {
public:
    explicit Reach(const LightItem& light) : light_(light) {
        if (light.kind != LightKind::spot) return;
        const double half = std::tan(std::min(light.outer_cone_rad, kWidestMap_rad));
        const double far_m = light.range_m > 0.0 ? light.range_m : std::numeric_limits<double>::infinity();
        // A cone wider than one map also lights what the pyramid misses: then only the range limits.
        if (light.outer_cone_rad <= kWidestMap_rad)
            cone_ = pyramid(light.position_ws_m, light.rotation_ws, half, far_m);
    }

    bool touches(const math::Aabb& box) const {
        if (light_.kind == LightKind::directional) return true;
        if (light_.range_m > 0.0 && !(math::distance(box, light_.position_ws_m) <= light_.range_m)) return false;
        return cone_.plane_count == 0 || math::may_overlap(cone_, box);
    }

private:
    const LightItem& light_;
    math::Frustum cone_;
};

/// Box of a world box in the light's own axes, relative to origin_ws.
math::Aabb in_light_axes(const math::Aabb& box_ws, const glm::dmat3& light_basis, const glm::dvec3& origin_ws) {
    const glm::dmat3 light_from_world = glm::transpose(light_basis);
    return math::transformed({box_ws.min - origin_ws, box_ws.max - origin_ws}, light_from_world, glm::dvec3(0.0));
}

void select_receivers(const SceneSnapshot& scene, std::span<const math::Frustum> seen, const Reach& reach,
                      PotentialSets& sets, ShadowFrame& frame) {
    sets.receivers.first = static_cast<std::uint32_t>(frame.receiver_items.size());
    sets.receiver_points.first = static_cast<std::uint32_t>(frame.receiver_points_ws.size());
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceItem& item = scene.instances[i];
        if (!item.visible || !item.receives || !reach.touches(item.bounds_ws)) continue;
        std::size_t points = 0;
        for (const math::Frustum& frustum : seen)
            if (math::may_overlap(frustum, item.bounds_ws))
                points += math::clip_box(frustum, item.bounds_ws, frame.receiver_points_ws);
        if (points > 0) frame.receiver_items.push_back(i);
    }
    sets.receivers.count = static_cast<std::uint32_t>(frame.receiver_items.size()) - sets.receivers.first;
    sets.receiver_points.count =
        static_cast<std::uint32_t>(frame.receiver_points_ws.size()) - sets.receiver_points.first;
}

/// Casters of a sun: in the box swept from the receivers toward the light.
void select_swept_casters(const SceneSnapshot& scene, const LightItem& light, const PotentialSets& sets,
                          ShadowFrame& frame) {
    const glm::dmat3 basis = math::basis_from_back(light.rotation_ws[2]);
    const auto points =
        std::span(frame.receiver_points_ws).subspan(sets.receiver_points.first, sets.receiver_points.count);
    math::Aabb swept;
    for (const glm::dvec3& p : points) swept = math::extended(swept, (p - points.front()) * basis);
    swept.max.z = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceItem& item = scene.instances[i];
        if (item.casts && math::overlaps(swept, in_light_axes(item.bounds_ws, basis, points.front())))
            frame.caster_items.push_back(i);
    }
}

/// Casters of a local light: within its reach and nearer than the farthest receiver point.
void select_near_casters(const SceneSnapshot& scene, const LightItem& light, const Reach& reach,
                         const PotentialSets& sets, ShadowFrame& frame) {
    double farthest_m = 0.0;
    const auto points =
        std::span(frame.receiver_points_ws).subspan(sets.receiver_points.first, sets.receiver_points.count);
    for (const glm::dvec3& p : points) farthest_m = std::max(farthest_m, glm::distance(p, light.position_ws_m));
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceItem& item = scene.instances[i];
        if (item.casts && reach.touches(item.bounds_ws) &&
            math::distance(item.bounds_ws, light.position_ws_m) <= farthest_m)
            frame.caster_items.push_back(i);
    }
}

}  // namespace

void select_sets(const SceneSnapshot& scene, ShadowFrame& frame) {
    frame.sets.clear();
    frame.receiver_items.clear();
    frame.caster_items.clear();
    frame.receiver_points_ws.clear();
    frame.seen.clear();
    for (const ConsumerItem& consumer : scene.consumers) frame.seen.push_back(consumer_frustum(consumer));
    for (const ShadowDemand& demand : frame.demands) {
        const LightTime time(frame, demand.light);
        PotentialSets sets;
        sets.skip = demand.skip;
        if (demand.skip == Reason::none) {
            const LightItem& light = scene.lights[demand.light];
            const Reach reach(light);
            select_receivers(scene, frame.seen, reach, sets, frame);
            sets.casters.first = static_cast<std::uint32_t>(frame.caster_items.size());
            if (sets.receivers.count == 0) {
                sets.skip = Reason::no_visible_receiver;
            } else {
                if (light.kind == LightKind::directional)
                    select_swept_casters(scene, light, sets, frame);
                else
                    select_near_casters(scene, light, reach, sets, frame);
                sets.casters.count = static_cast<std::uint32_t>(frame.caster_items.size()) - sets.casters.first;
                if (sets.casters.count == 0) sets.skip = Reason::no_caster;
            }
        }
        frame.sets.push_back(sets);
    }
}

}  // namespace gnomon::shadow
