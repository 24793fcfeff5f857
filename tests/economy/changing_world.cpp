#include "tests/economy/changing_world.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <iterator>

#include "gnomon/components.h"

namespace gnomon {
namespace {

constexpr double kStill = 0.5;  // share of the frames in which nothing changes

}  // namespace

ChangingWorld::ChangingWorld(std::uint64_t seed, std::vector<ShadowFilter> filters)
    : RandomChoice(seed), filters_(std::move(filters)) {
    world_.add_mesh(kPlane, {0, 0, 0}, false);
    add_camera();
    for (std::size_t i = 0; i < kMostLights / 2; ++i) add_light();
    for (std::size_t i = 0; i < kMostCasters / 2; ++i) add_caster();
}

std::uint32_t ChangingWorld::below(std::size_t count) {
    return std::uniform_int_distribution<std::uint32_t>(0, static_cast<std::uint32_t>(count) - 1)(random_);
}

void ChangingWorld::put_any_shadow(ecs::Entity light) {
    constexpr std::uint32_t kLeastMap_px = 32;
    LightShadow shadow;
    ShadowTuning tuning;
    shadow.filter = any_of(filters_);
    shadow.resolution_px = kLeastMap_px << below(4);
    tuning.cascades.fit = static_cast<ShadowFit>(below(3));
    shadow.cascades = 1 + below(4);
    tuning.cascades.blend = chance(0.5) ? 0.1f : 0.0f;
    tuning.cascades.splits = chance(0.5) ? CascadeSplits::practical : CascadeSplits::seen;
    shadow.caster_faces = static_cast<CasterFaces>(below(4));
    tuning.maps.cube_route = static_cast<CubeRoute>(below(4));
    tuning.maps.multi_draw = below(4) > 0;
    tuning.maps.depth_format = static_cast<DepthFormat>(below(3));
    if (chance(0.3)) shadow.layers = static_cast<ShadowLayers>(1u + below(3));
    const bool is_wide = chance(0.3);
    if (chance(0.2)) tuning.projection.near_m = 0.5f, tuning.projection.far_m = 12.0f;
    if (chance(0.1)) tuning.cascades.warp = 0.5f;
    if (chance(0.1)) tuning.projection.kind = LightProjection::perspective;
    shadow.enabled = chance(0.9);
    world_.registry.emplace<LightShadow>(light, shadow);
    world_.registry.emplace<ShadowTuning>(light, tuning);
    world_.registry.patch<Light>(light, [&](Light& l) {
        l.source_radius_m = is_wide ? 0.1f : 0.0f;
        l.sun_radius_rad = is_wide ? 0.02f : 0.0f;
    });
}

void ChangingWorld::add_light() {
    if (lights_.size() == kMostLights) return;
    const ecs::Entity light = world_.add_light(static_cast<LightKind>(below(3)), place(1.0, 8.0), "light", false);
    if (chance(0.9)) put_any_shadow(light);
    lights_.push_back(light);
}

void ChangingWorld::add_caster() {
    if (casters_.size() == kMostCasters) return;
    constexpr std::uint32_t kMeshes[] = {kBox, kMaskedBox, kMixedBox, kSolidBox, kBlendedBox};
    casters_.push_back(world_.add_mesh(kMeshes[below(std::size(kMeshes))], place(0.2, 4.0), true));
}

void ChangingWorld::add_camera() {
    if (cameras_.size() == kMostCameras) return;
    cameras_.push_back(world_.add_camera({0, 5, 10}, {0, 0, 0}));
    turn_camera(cameras_.back());
}

/// Moves the camera: mostly by a step, sometimes to any place, also to where nothing is.
void ChangingWorld::turn_camera(ecs::Entity camera) {
    const glm::dvec3 jump_m = place(0.5, 8.0), step_m = 0.01 * place(-1.0, 1.0), target_m = place(-6.0, 6.0);
    const bool jumps = chance(0.3);
    world_.registry.patch<Transform>(camera, [&](Transform& t) {
        t.translation_m = jumps ? jump_m : t.translation_m + step_m;
        if (jumps) t.rotation = glm::quatLookAt(glm::normalize(target_m - jump_m), glm::dvec3(0, 1, 0));
    });
    if (!chance(0.2)) return;
    const bool orthographic = chance(0.3);
    const double far_m = chance(0.3) ? 12.0 : 1.0e9;
    world_.registry.patch<Camera>(camera, [&](Camera& c) {
        c.projection = orthographic ? CameraProjection::orthographic : CameraProjection::perspective;
        c.far_m = far_m;
    });
}

void ChangingWorld::change_light(ecs::Entity light) {
    if (!world_.registry.has<LightShadow>(light)) {
        put_any_shadow(light);
    } else if (chance(0.1)) {
        world_.registry.remove<LightShadow>(light);
    } else if (chance(0.5)) {
        put_any_shadow(light);
    }
    if (chance(0.5)) world_.move(light, place(0.5, 8.0));
    if (!chance(0.4)) return;
    Light other = *world_.registry.get<Light>(light);  // its size stays
    other.kind = static_cast<LightKind>(below(3));
    other.intensity = chance(0.1) ? 0.0f : 100.0f;
    other.range_m = static_cast<float>(chance(0.3) ? 0.0 : number(1.0, 20.0));
    other.outer_cone_rad = static_cast<float>(number(0.2, 1.5));
    world_.registry.patch<Light>(light, [&](Light& l) { l = other; });
}

void ChangingWorld::change_caster(ecs::Entity caster) {
    const double what = number(0.0, 1.0);
    if (what < 0.6) {
        world_.move(caster, place(0.2, 4.0));
    } else if (what < 0.7) {
        const double scale = number(-1.5, 1.5);  // below 0: mirrored
        world_.registry.patch<Transform>(caster, [&](Transform& t) { t.scale = glm::dvec3(scale, 1.0, 1.0); });
    } else if (what < 0.8) {
        const std::uint32_t mesh = chance(0.5) ? kMaskedBox : kSolidBox;
        const bool visible = chance(0.8), receives = chance(0.8);
        const auto layers = static_cast<ShadowLayers>(1u + below(3));
        world_.registry.patch<MeshRef>(caster, [&](MeshRef& m) { m = {mesh, visible, receives, layers}; });
    } else if (world_.registry.has<ShadowCaster>(caster)) {
        const auto layers = static_cast<ShadowLayers>(1u + below(3));
        if (chance(0.5))
            world_.registry.remove<ShadowCaster>(caster);
        else
            world_.registry.patch<ShadowCaster>(caster, [&](ShadowCaster& c) { c.layers = layers; });
    } else {
        world_.registry.emplace<ShadowCaster>(caster);
    }
}

void ChangingWorld::remove_one(std::vector<ecs::Entity>& from) {
    if (from.empty()) return;
    const std::uint32_t i = below(from.size());
    world_.registry.destroy(from[i]);
    from.erase(from.begin() + i);
}

void ChangingWorld::change() {
    if (chance(kStill)) return;
    if (chance(0.1)) add_light();
    if (chance(0.07)) remove_one(lights_);
    if (chance(0.15)) add_caster();
    if (chance(0.12)) remove_one(casters_);
    if (chance(0.1)) add_camera();
    if (cameras_.size() > 1 && chance(0.1)) remove_one(cameras_);
    if (!lights_.empty() && chance(0.4)) change_light(any_of(lights_));
    if (!casters_.empty() && chance(0.4)) change_caster(any_of(casters_));
    if (chance(0.5)) turn_camera(any_of(cameras_));
}

}  // namespace gnomon
