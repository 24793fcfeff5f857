#include "bench/common/box_field_scene.h"

#include <cmath>
#include <random>

#include "engine/math/frustum.h"
#include "systems/extract/scene_tree.h"

namespace gnomon::bench {

SceneSnapshot plain(std::int64_t boxes, LightKind kind, double sight_m) {
    std::mt19937_64 random(7);
    const double side_m = 5.0 * std::sqrt(static_cast<double>(boxes));
    const auto number = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    SceneSnapshot scene;
    for (std::int64_t i = 0; i < boxes; ++i) {
        InstanceItem item;
        item.mesh = static_cast<std::uint32_t>(i % kPlainMeshes);
        item.gpu_slot = static_cast<std::uint32_t>(i);
        const glm::dvec3 centre(number(-0.5, 0.5) * side_m, number(0.0, 2.0), number(-0.5, 0.5) * side_m);
        const glm::dvec3 half(number(0.2, 1.0), number(0.2, 2.0), number(0.2, 1.0));
        item.bounds_ws = {centre - half, centre + half};
        item.casts = true;
        scene.instances.push_back(item);
    }
    ConsumerItem camera;
    camera.position_ws_m = {0.0, 10.0, 0.5 * side_m};
    camera.rotation_ws = math::basis_from_back(glm::dvec3(0.0, 0.3, 1.0));
    camera.fov_y_rad = 1.2;
    camera.far_m = sight_m > 0.0 ? sight_m : 4.0 * side_m;
    scene.consumers.push_back(camera);
    LightItem light;
    light.kind = kind;
    light.intensity = 1.0f;
    light.has_shadow = true;
    light.shadow.resolution_px = 2048;
    light.position_ws_m = {0.0, 40.0, 0.5 * side_m - 40.0};
    light.rotation_ws = math::basis_from_back(glm::dvec3(0.4, 1.0, 0.2));
    light.outer_cone_rad = 0.9;
    scene.lights.push_back(light);
    scene.list_version = 1;  // as in a frame's snapshot: the list of instances is read once
    build_tree(scene);
    return scene;
}

shadow::FitInput fit_input(const SceneSnapshot& scene, shadow::FitStages& stages,
                           const shadow::LightFitHistory& previous, shadow::LightFitHistory& next) {
    const shadow::ReceiverCasterSets& sets = stages.frame.sets;
    const shadow::LightSetsView light{sets, sets.lights[0]};
    const shadow::ShadowRequest& request = stages.frame.requests[0];
    return {.light = scene.lights[0],
            .request = request,
            .scene = scene,
            .receivers = light.receivers(),
            .casters = light.casters(),
            .receiver_points_ws = light.receiver_points_ws(),
            .error_points_ws = light.error_points_ws(),
            .hulls = light.hulls(),
            .frame_points_ws = sets.receiver_points_ws,
            .reach_texel = request.map.filtering.widest_texel,
            .sampled_depths = stages.sampled_depths,
            .scratch = stages.storage.scratch.front().fits,
            .previous = previous,
            .next = next};
}

}  // namespace gnomon::bench
