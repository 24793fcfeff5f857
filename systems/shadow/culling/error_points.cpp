#include "systems/shadow/culling/error_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "systems/extract/volumes.h"
#include "systems/shadow/culling/inner_receivers.h"

namespace gnomon::shadow {
namespace {

/// Planes around what a camera sees from a distance on within a light frustum.
class ClipPlanes {
public:
    ClipPlanes(const ConsumerItem& consumer, std::span<const math::Plane> sides, double from_m) {
        const math::Frustum frustum = consumer_frustum(consumer, std::max(consumer.near_m, from_m));
        const auto seen = math::planes_of(frustum);
        const auto end = std::copy(sides.begin(), sides.end(), std::copy(seen.begin(), seen.end(), planes_.begin()));
        count_ = static_cast<std::size_t>(end - planes_.begin());
    }
    std::span<const math::Plane> all() const { return std::span(planes_).first(count_); }

private:
    std::array<math::Plane, math::kMaxClipPlanes> planes_;
    std::size_t count_ = 0;
};

double farthest_depth_m(const ConsumerItem& consumer, std::span<const glm::dvec3> points_ws) {
    double farthest_m = 0.0;
    for (const glm::dvec3& p_ws : points_ws)
        farthest_m = std::max(farthest_m, glm::dot(consumer.position_ws_m - p_ws, consumer.rotation_ws[2]));
    return farthest_m;
}

}  // namespace

void append_error_points(const SceneSnapshot& scene, const SeenReceivers& seen, const LightReach& reach,
                         SetScratch& scratch, ReceiverCasterSets& out) {
    const ConsumerItem& consumer = scene.consumers[seen.camera];
    const ClipPlanes whole(consumer, seen.sides, consumer.near_m);
    scratch.surfaces.clear();
    for (const std::uint32_t i : seen.items) {
        if (!is_air(scene.instances[i])) {
            scratch.surfaces.push_back(i);
            continue;
        }
        const math::Aabb box = reach.clipped(scene.instances[i].bounds_ws);
        scratch.points_ws.clear();
        if (math::clip_box(whole.all(), box, scratch.points_ws) == 0) continue;
        const double from_m = kAirShare * farthest_depth_m(consumer, scratch.points_ws);
        math::clip_box(ClipPlanes(consumer, seen.sides, from_m).all(), box, out.error_points_ws);
    }
    const double nearest_m = out.nearest_surface_m[seen.camera];
    if (scratch.surfaces.empty() || !std::isfinite(nearest_m)) return;
    const ClipPlanes planes(consumer, seen.sides, nearest_m);
    const math::Aabb limit = reach.bounds();
    const SplitReceivers split =
        split_receivers(scene, scratch.surfaces, {planes.all(), limit, seen.core}, scratch.split);
    out.error_points_ws.insert(out.error_points_ws.end(), split.corners_ws_m.begin(), split.corners_ws_m.end());
    for (const std::uint32_t i : split.others)
        math::clip_box(planes.all(), reach.clipped(scene.instances[i].bounds_ws), out.error_points_ws);
}

}  // namespace gnomon::shadow
