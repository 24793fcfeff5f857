// The shortest way: Gnomon's window, registry and frame. Exit code 0: the shadow is where it belongs.
#include <cstdio>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <vector>

#include <gnomon/components.h>
#include <gnomon/frame.h>
#include <gnomon/registry.h>
#include <gnomon/window.h>

#include "ground_and_box.h"

namespace {

using namespace gnomon;

int fail(const char* what) {
    std::fprintf(stderr, "three_lines: %s\n", what);
    return 1;
}

struct World {
    ecs::Registry registry;
    ecs::Entity box, sun;
};

World make_world() {
    World world;
    ecs::Registry& registry = world.registry;
    const ecs::Entity ground = registry.create(), camera = registry.create();
    world.box = registry.create();
    world.sun = registry.create();
    registry.emplace<Transform>(ground);
    registry.emplace<MeshRef>(ground, {.mesh = kGroundMesh});
    registry.emplace<Transform>(world.box, {.translation_m = {0.0, kBoxHeight_m, 0.0}});
    registry.emplace<MeshRef>(world.box, {.mesh = kBoxMesh});
    const glm::dquat looking_down = glm::angleAxis(-std::numbers::pi / 2.0, glm::dvec3(1.0, 0.0, 0.0));
    registry.emplace<Transform>(camera, {.translation_m = {0.0, kEyeHeight_m, 0.0}, .rotation = looking_down});
    registry.emplace<Camera>(
        camera,
        {.projection = CameraProjection::orthographic, .half_height_m = kHalfHeight_m, .near_m = 0.1, .far_m = 20.0});
    registry.emplace<Transform>(world.sun, {.rotation = glm::quatLookAt(glm::normalize(glm::dvec3(1.0, -1.0, 0.0)),
                                                                        glm::dvec3(0.0, 0.0, 1.0))});
    return world;
}

}  // namespace

int main() {
    // [window]
    auto window = Window::open({.size_px = {kPicture_px, kPicture_px}, .headless = true, .frames = 2});
    if (!window) return fail(to_line(window.error()).c_str());
    // [window]

    World world = make_world();
    ecs::Registry& registry = world.registry;
    const ecs::Entity sun = world.sun, box = world.box;
    // [three lines]
    registry.emplace<Light>(sun, {.kind = LightKind::directional, .intensity = 50000.0f});
    registry.emplace<LightShadow>(sun);
    registry.emplace<ShadowCaster>(box);
    // [three lines]

    // [frame]
    const assets::MeshLibrary library = ground_and_box();
    auto frame = Frame::create(library);
    if (!frame) return fail(to_line(frame.error()).c_str());
    const FrameSettings settings{.viewport_px = window.value()->size_px(), .exposure_ev = 14.0f};
    frame.value()->run(registry, settings);
    // [frame]

    // [report]
    for (const LightReport& light : frame.value()->report().lights)
        std::printf("%s: %s, %s %u maps\n", light.name.c_str(), to_text(light.state), reason_text(light.reason),
                    light.counts.views);
    // [report]
    if (frame.value()->report().lights.at(0).state != LightState::rendered) return fail("no map was drawn");
    std::vector<float> visibility;
    if (!frame.value()->read_visibility(sun, visibility)) return fail("no visibility");
    const auto visible = [&](int column) {
        return visibility[static_cast<std::size_t>(kMiddleRow * kPicture_px + column)];
    };
    if (visible(kShadowedColumn) != 0.0f || visible(kLitColumn) != 1.0f) return fail("the wrong visibility");

    std::vector<std::uint8_t> rgba;
    if (frame.value()->picture_texture() == 0 || !frame.value()->read_picture(rgba)) return fail("no picture");
    const auto red = [&](int column) {
        return int{rgba[static_cast<std::size_t>((kMiddleRow * kPicture_px + column) * 4)]};
    };
    std::printf("red: %d in the shadow, %d in the light\n", red(kShadowedColumn), red(kLitColumn));
    if (!is_darker(red(kShadowedColumn), red(kLitColumn))) return fail("no shadow in the picture");

    // An unchanged frame keeps its map. A frame with the memory of this one draws the same picture.
    frame.value()->run(registry, settings);
    if (frame.value()->report().lights.at(0).state != LightState::reused) return fail("an unchanged map was drawn");
    auto next = Frame::create(library, {.history = frame.value()->history()});
    if (!next) return fail(to_line(next.error()).c_str());
    next.value()->run(registry, settings);
    std::vector<std::uint8_t> again;
    if (!next.value()->read_picture(again) || again != rgba) return fail("another picture by the next frame");

    // Without the caster there is none: the shadow was not something else.
    registry.remove<ShadowCaster>(box);
    frame.value()->run(registry, settings);
    if (!frame.value()->read_picture(rgba)) return fail("no picture");
    if (red(kShadowedColumn) != red(kLitColumn)) return fail("a shadow without a caster");
    return 0;
}
