#include "tests/system/fault_scenes.h"

#include <stdexcept>

#include "sample_game/support/scene/node_motion.h"
#include "sample_game/support/scene/open_scene.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "tests/system/test_world.h"

namespace gnomon {
namespace {

constexpr double kFrame_s = 1.0 / 60.0;

FaultScene courtyard(CascadeSplits splits, ShadowFit fit) {
    auto data = game::load_game_scene();
    if (!data) throw std::runtime_error(to_line(data.error()));
    const auto library = std::make_shared<assets::MeshLibrary>();
    const auto registry = std::make_shared<ecs::Registry>();
    const game::SpawnedScene scene = game::spawn_scene(std::move(data).value(), *registry, *library);
    for (const game::NamedEntity& light : scene.lights)
        if (registry->has<LightShadow>(light.entity))
            registry->emplace<ShadowTuning>(light.entity, {.cascades = {.fit = fit, .splits = splits}});
    const auto play = [registry, moving = scene.moving](int frame) {
        game::apply_motion(moving, frame * kFrame_s, *registry);
    };
    return {library, registry, play};
}

}  // namespace

FaultScene box_scene() {
    const auto world = std::make_shared<TestWorld>();
    const TestWorld::Stage stage = world->add_stage();
    world->add_mesh(kMaskedBox, {1.5, 1, 0}, true);
    world->add_mesh(kBlendedBox, {-1.5, 1, 0}, false);
    world->add_light(LightKind::directional, kLightPlace_m, "sun");
    world->add_light(LightKind::spot, kLightPlace_m, "spot");
    world->add_light(LightKind::point, {0, 4, 0}, "point");
    const auto prefiltered = [&](LightKind kind, const char* name, ShadowFilter filter) {
        const ecs::Entity light = world->add_light(kind, kLightPlace_m, name);
        world->registry.patch<LightShadow>(light, [filter](LightShadow& shadow) { shadow.filter = filter; });
    };
    prefiltered(LightKind::spot, "variance", ShadowFilter::vsm);
    prefiltered(LightKind::point, "moments", ShadowFilter::moments);
    const auto newcomer = std::make_shared<ecs::Entity>();
    const auto play = [world, newcomer, box = stage.box](int frame) {
        if (frame == 0 && world->registry.alive(*newcomer)) world->registry.destroy(*newcomer);
        if (frame == 1) *newcomer = world->add_mesh(kBox, {0, 1, 1.5}, true);
        world->move(box, {0.01 * frame, 1, 0});
    };
    return {std::make_shared<assets::MeshLibrary>(test_library()), {world, &world->registry}, play};
}

FaultScene exact_scene() {
    const auto world = std::make_shared<TestWorld>();
    const TestWorld::Stage stage = world->add_stage();
    world->add_mesh(kMaskedBox, {1.5, 1, 0}, true);
    world->add_mesh(kBlendedBox, {-1.5, 1, 0}, false);
    const auto add = [&](LightKind kind, const char* name, ShadowFilter filter) {
        const ecs::Entity light = world->add_light(kind, kLightPlace_m, name);
        world->registry.emplace<LightShadow>(light, {.filter = filter, .resolution_px = 128});
        return light;
    };
    add(LightKind::spot, "exact", ShadowFilter::exact);
    const ecs::Entity soft = add(LightKind::point, "soft", ShadowFilter::exact_soft);
    world->registry.patch<Light>(soft, [](Light& light) { light.source_radius_m = 0.1f; });
    const ecs::Entity eye = add(LightKind::directional, "eye", ShadowFilter::exact);
    world->registry.emplace<ShadowTuning>(eye, {.projection = {.kind = LightProjection::perspective}});
    const auto play = [world, box = stage.box](int frame) { world->move(box, {0.01 * frame, 1, 0}); };
    return {std::make_shared<assets::MeshLibrary>(test_library()), {world, &world->registry}, play};
}

FaultScene catcher_scene() {
    const auto world = std::make_shared<TestWorld>();
    const TestWorld::Stage stage = world->add_stage();
    world->registry.patch<MeshRef>(stage.plane, [](MeshRef& m) { m.shadow_catcher = true; });
    world->add_light(LightKind::directional, kLightPlace_m, "sun");
    world->add_light(LightKind::point, {0, 4, 0}, "point");
    const auto play = [world, box = stage.box](int frame) { world->move(box, {0.01 * frame, 1, 0}); };
    return {std::make_shared<assets::MeshLibrary>(test_library()), {world, &world->registry}, play};
}

FaultScene courtyard_scene() { return courtyard(ShadowTuning::Cascades{}.splits, ShadowTuning::Cascades{}.fit); }
// Tight, because other fits depend on earlier ones. They would go on from a fit made while depths were missing, not
// from the fit without a fault.
FaultScene sampled_courtyard_scene() { return courtyard(CascadeSplits::sampled, ShadowFit::tight); }

}  // namespace gnomon
