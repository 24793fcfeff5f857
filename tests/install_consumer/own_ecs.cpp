// Another ECS, another context: a vector of structs fills the snapshot, and Gnomon's systems do the rest without its
// registry. Exit code 0: the shadow is where it belongs, follows the box, and an unchanged frame redraws no map.
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "engine/gl/device_gl45.h"
#include "ground_and_box.h"
#include "own_context.h"
#include "own_frame.h"

namespace {

using namespace gnomon;

int fail(const std::string& what) {
    std::fprintf(stderr, "own_ecs: %s\n", what.c_str());
    return 1;
}

// [world]
/// The stranger's ECS.
struct Thing {
    enum class Kind { mesh, sun, camera } kind = Kind::mesh;
    std::uint32_t mesh = 0;
    glm::dvec3 position_m{0.0};
    glm::dvec3 back{0.0, 0.0, 1.0};  // against the direction in which a sun shines, a camera looks
    bool casts = false, moved = true;
    std::uint64_t version = 0;  // of the snapshot in which it last moved
};
using Things = std::vector<Thing>;
// [world]

// [identity]
/// Any number pair that no two things share at a time, and that a thing keeps.
ecs::Entity entity_of(std::size_t i) { return {static_cast<std::uint32_t>(i), 1}; }
// [identity]

glm::dmat3 rotation_of(const glm::dvec3& back) {
    const glm::dvec3 aside = std::abs(back.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 up = glm::normalize(glm::cross(back, aside)), right = glm::cross(up, back);
    return {right, up, back};
}

// [snapshot]
void fill_snapshot(Things& things, const assets::MeshLibrary& library, glm::uvec2 picture_px, SceneSnapshot& scene) {
    ++scene.version;  // grows when anything changed
    scene.changed_instances.clear();
    scene.consumers.clear();
    scene.lights.clear();
    scene.instances.clear();
    for (std::size_t i = 0; i < things.size(); ++i) {
        Thing& thing = things[i];
        if (thing.moved) thing.version = scene.version;
        switch (thing.kind) {
            case Thing::Kind::camera:
                scene.consumers.push_back({.entity = entity_of(i),
                                           .name = "camera",
                                           .position_ws_m = thing.position_m,
                                           .rotation_ws = rotation_of(thing.back),
                                           .projection = CameraProjection::orthographic,
                                           .half_height_m = kHalfHeight_m,
                                           .near_m = 0.1,
                                           .far_m = 20.0,
                                           .viewport_px = picture_px});
                break;
            case Thing::Kind::sun:
                scene.lights.push_back({.entity = entity_of(i),
                                        .name = "sun",
                                        .kind = LightKind::directional,
                                        .rotation_ws = rotation_of(thing.back),
                                        .intensity = 50000.0f,
                                        .has_shadow = true,
                                        .version = thing.version});
                break;
            case Thing::Kind::mesh:
                InstanceItem item;
                item.entity = entity_of(i);
                item.mesh = thing.mesh;
                item.gpu_slot = static_cast<std::uint32_t>(i);  // below gpu_slot_count, its own for as long as it lives
                item.translation_ws_m = thing.position_m;
                item.bounds_ws = math::transformed(library.meshes[thing.mesh].bounds_ms, item.basis, thing.position_m);
                item.casts = thing.casts;
                item.version = thing.version;  // grows when the thing changed: a map holds while its casters' do
                if (thing.moved) scene.changed_instances.push_back(static_cast<std::uint32_t>(scene.instances.size()));
                scene.instances.push_back(item);
                break;
        }
        thing.moved = false;
    }
    scene.gpu_slot_count = static_cast<std::uint32_t>(things.size());
}
// [snapshot]

/// Red of the middle row, left to right.
std::vector<int> middle_row(gl::Device& device, gl::TextureHandle picture) {
    std::vector<std::uint8_t> rgba(std::size_t{kPicture_px} * kPicture_px * 4);
    std::vector<int> row;
    if (!device.read_texture(picture, 0, std::as_writable_bytes(std::span(rgba)))) return row;
    for (int x = 0; x < kPicture_px; ++x)
        row.push_back(rgba[static_cast<std::size_t>((kMiddleRow * kPicture_px + x) * 4)]);
    return row;
}

int run() {
    auto device = gl::make_gl45_device({});
    if (!device) return fail(to_line(device.error()));
    const assets::MeshLibrary library = ground_and_box();
    auto gpu_scene = GpuScene::create(*device.value(), library);
    if (!gpu_scene) return fail(to_line(gpu_scene.error()));
    OwnFrame frame(*device.value(), std::move(gpu_scene).value());
    device.value()->set_timing(gl::TimingMode::finish);

    Things things = {{.mesh = kGroundMesh},
                     {.mesh = kBoxMesh, .position_m = {0.0, kBoxHeight_m, 0.0}, .casts = true},
                     {.kind = Thing::Kind::sun, .back = glm::normalize(glm::dvec3(-1.0, 1.0, 0.0))},
                     {.kind = Thing::Kind::camera, .position_m = {0.0, kEyeHeight_m, 0.0}, .back = {0.0, 1.0, 0.0}}};
    SceneSnapshot scene;
    const auto step = [&] {
        fill_snapshot(things, library, {kPicture_px, kPicture_px}, scene);
        return frame.run(scene);
    };

    if (!step()) return fail("the first frame failed");
    const std::vector<int> first = middle_row(*device.value(), frame.picture());
    if (first.empty()) return fail("no picture");
    std::printf("red: %d in the shadow, %d in the light; the map: %s\n", first[kShadowedColumn], first[kLitColumn],
                reason_code(frame.report.lights[0].reason));
    if (!is_darker(first[kShadowedColumn], first[kLitColumn])) return fail("no shadow in the picture");
    if (frame.report.lights[0].state != LightState::rendered) return fail("the first frame drew no map");

    if (!step()) return fail("the second frame failed");
    if (frame.report.lights[0].state != LightState::reused) return fail("an unchanged frame drew its map again");
    if (middle_row(*device.value(), frame.picture()) != first) return fail("an unchanged frame gave another picture");
    if (!frame.report.lights[0].why.saved_us) return fail("nobody learns what a map takes");
    for (int i = 0; i < 3; ++i)
        if (!step()) return fail("a still frame failed");
    if (frame.report.lights[0].kept.reason != Reason::visibility_kept) return fail("still frames look the light up");
    if (middle_row(*device.value(), frame.picture()) != first) return fail("what is kept is another picture");

    things[1].position_m.x -= 2.5;  // the shadow now lies where it was light
    things[1].moved = true;
    if (!step()) return fail("the third frame failed");
    const std::vector<int> moved = middle_row(*device.value(), frame.picture());
    if (frame.report.lights[0].state != LightState::rendered) return fail("a moved caster drew no map");
    if (!is_darker(moved[kLitColumn], first[kLitColumn]) || moved[kShadowedColumn] != first[kLitColumn])
        return fail("the shadow did not follow the box");
    return 0;
}

}  // namespace

int main() {
    const OwnContext context;
    if (!context) return fail("no OpenGL 4.5 context");
    return run();
}
