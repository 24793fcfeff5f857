#include "systems/shadow/culling/nearest_receiver.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>

#include "engine/math/shape_tree.h"
#include "systems/extract/scene_tree.h"
#include "systems/extract/volumes.h"

namespace gnomon::shadow {
namespace {

/// A camera's frustum and its view depth, both in the space of an object.
struct Sight {
    std::array<math::Plane, 6> planes;
    std::size_t count = 0;
    math::Ramp depth_m;

    std::span<const math::Plane> within() const { return std::span(planes).first(count); }
};

/// Returns the camera's frustum relative to its position. Offsets from the world's origin would round by the camera's
/// distance from there.
Sight from_own_place(const ConsumerItem& consumer) {
    const math::Frustum frustum = consumer_frustum_at_origin(consumer);
    Sight sight;
    for (const math::Plane& plane : math::planes_of(frustum)) sight.planes[sight.count++] = plane;
    sight.depth_m = {-consumer.rotation_ws[2], 0.0};
    return sight;
}

/// Transforms `sight` into the space that `basis` and then `translation_m` map to its own. Normals get unit length, so
/// that their squares stay in the range of double at any scale.
Sight carried(const Sight& sight, const glm::dmat3& basis, const glm::dvec3& translation_m) {
    Sight out;
    for (const math::Plane& plane : sight.within()) {
        const glm::dvec3 normal = plane.normal * basis;
        const double length = glm::length(normal);
        out.planes[out.count++] = {normal / length, (glm::dot(plane.normal, translation_m) + plane.offset) / length};
    }
    out.depth_m = {sight.depth_m.gradient * basis,
                   glm::dot(sight.depth_m.gradient, translation_m) + sight.depth_m.offset};
    return out;
}

bool is_finite(const Sight& sight) {
    double sum = sight.depth_m.offset + glm::dot(sight.depth_m.gradient, glm::dvec3(1.0));
    for (const math::Plane& plane : sight.within()) sum += plane.offset + glm::dot(plane.normal, glm::dvec3(1.0));
    return std::isfinite(sum);
}

/// Relative rounding error of bounding boxes, which are sums of four rounded numbers (math::transformed).
constexpr double kBoundsRounding = 0x1p-51;

math::Aabb seen_from(const glm::dvec3& place_ws_m, const math::Aabb& box_ws) {
    const glm::dvec3 slack = kBoundsRounding * glm::max(glm::abs(box_ws.min), glm::abs(box_ws.max));
    return {box_ws.min - slack - place_ws_m, box_ws.max + slack - place_ws_m};
}

}  // namespace

double nearest_receiver_m(const SceneSnapshot& scene, const ConsumerItem& consumer, ShadowLayers layers,
                          std::vector<glm::dvec3>& scratch, ReceiverKinds kinds) {
    const Sight own = from_own_place(consumer);
    const auto rank = [&](const math::Aabb& box_ws) {
        return math::lowest_corner(seen_from(consumer.position_ws_m, box_ws), own.depth_m, own.within());
    };
    const auto depth_m = [&](std::uint32_t i, double lowest) {
        const InstanceItem& item = scene.instances[i];
        if (!item.visible || !item.receives || (item.receive_layers & layers) == 0) return lowest;
        if (kinds == ReceiverKinds::surfaces && is_air(item)) return lowest;
        const math::ShapeTree* shape = shape_of(scene.meshes, item.mesh);
        if (shape) {
            const Sight sight = carried(own, item.basis, item.translation_ws_m - consumer.position_ws_m);
            if (is_finite(sight)) return shape->lowest(sight.depth_m, sight.within(), lowest, scratch);
        }
        const math::Aabb box = seen_from(consumer.position_ws_m, item.bounds_ws);
        return math::lowest_in(box, own.depth_m, own.within(), lowest, scratch);
    };
    return lowest_of_instances(scene, rank, depth_m);
}

}  // namespace gnomon::shadow
