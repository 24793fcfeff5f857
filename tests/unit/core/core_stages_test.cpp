#include <gtest/gtest.h>

#include <optional>

#include "engine/gl/device_recording.h"
#include "gnomon/components.h"
#include "systems/extract/extract.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/shadow_system.h"
#include "systems/transform/transform_system.h"
#include "tests/system/test_world.h"
#include "tests/unit/core/core_scene.h"

/// gnomon/core.h gives what ShadowSystem gives for the same scene: there is one implementation.
namespace gnomon::core {
namespace {

class CoreStages : public ::testing::Test {
protected:
    CoreStages() {
        world.add_mesh(kPlane, {0.0, 0.0, 0.0}, false);
        for (int i = 0; i < 9; ++i) box = world.add_mesh(kBox, {-6.0 + 1.5 * i, 0.6, 2.0 * std::sin(1.0 * i)}, true);
        camera = world.add_camera({1.0, 4.0, 12.0}, {0.0, 0.0, 0.0});
        for (const gnomon::LightKind kind : {gnomon::LightKind::directional, gnomon::LightKind::spot, gnomon::LightKind::point})
            lights.push_back(world.add_light(kind, {3.0, 6.0, 2.5}, "light"));
        lights.push_back(world.add_light(gnomon::LightKind::spot, {-2.0, 3.0, 1.0}, "wide"));
        world.registry.patch<gnomon::Light>(lights.back(), [](gnomon::Light& light) { light.outer_cone_rad = 1.3f; });
        auto made = GpuScene::create(device, library);
        gpu.emplace(std::move(made).value());
    }
    ~CoreStages() override { system.reset(), gpu.reset(); }

    /// Runs a frame of ShadowSystem. It is given no shapes of meshes, which core does not have.
    const shadow::ShadowFrame& run_system() {
        extractor.update(world.registry, library, transforms.update(world.registry), {640, 360}, snapshot);
        SceneSnapshot boxes_only = snapshot;
        boxes_only.meshes.shapes.clear();
        gl::CommandList list;
        EXPECT_TRUE(gpu->update(snapshot, list));
        const shadow::ShadowFrame& frame = system->update(boxes_only, *gpu, {}, list, report);
        stages.emplace(frame.fitted);
        const bool executed = device.submit(list).failure == gl::Failure::none;
        system->commit(boxes_only, executed);
        return frame;
    }
    /// Returns the same world as an engine of its own would hand it over.
    OwnScene own_scene() const {
        OwnScene own;
        for (const InstanceItem& item : snapshot.instances) {
            Box handed;
            handed.min_ws_m = item.bounds_ws.min;
            handed.max_ws_m = item.bounds_ws.max;
            handed.casts = item.casts;
            own.boxes.push_back(handed);
        }
        Camera eye;
        eye.position_ws_m = world.registry.get<WorldTransform>(camera)->translation_ws_m;
        eye.rotation_ws = world.registry.get<WorldTransform>(camera)->basis;
        eye.viewport_px = {640, 360};
        own.cameras.push_back(eye);
        for (const ecs::Entity entity : lights) {
            const auto& component = *world.registry.get<gnomon::Light>(entity);
            const auto& place = *world.registry.get<WorldTransform>(entity);
            Light light;
            light.id = entity.index;
            light.kind = static_cast<LightKind>(component.kind);
            light.position_ws_m = place.translation_ws_m;
            light.rotation_ws = place.basis;
            light.range_m = component.range_m;
            light.outer_cone_rad = component.outer_cone_rad;
            own.lights.push_back(light);
        }
        return own;
    }
    static std::vector<std::uint32_t> sorted(std::span<const std::uint32_t> items) {
        std::vector<std::uint32_t> out(items.begin(), items.end());
        std::sort(out.begin(), out.end());
        return out;
    }
    /// Counts the differences of both results.
    int differences(const Fits& fits) const {
        int found = fits.views().size() == stages->views.size() ? 0 : 1;
        for (std::size_t v = 0; v < std::min(fits.views().size(), stages->views.size()); ++v) {
            const View& mine = fits.views()[v];
            const shadow::ShadowView& theirs = stages->views[v];
            found += mine.light != theirs.light || mine.layer != theirs.layer;
            found += mine.clip_from_anchor != theirs.clip_from_anchor;
            found += mine.map_from_anchor != theirs.map_from_anchor;
            found += mine.anchor_ws_m != theirs.pose.anchor_ws_m;
            found += mine.near_m != theirs.depth.near_m || mine.far_m != theirs.depth.far_m;
            found += mine.edge_error_px != theirs.error.edge_px;
            found += mine.to_m != theirs.cascade.seen_to_m || mine.fade_to_m != theirs.cascade.fades_to_m;
            found += mine.stays != theirs.stays || mine.empty != theirs.lit;
            found += sorted(fits.casters_of(mine)) != sorted(stages->casters_of(theirs));
            found += fits.lights()[mine.light].map_px != stages->lights[mine.light].request.map.resolution_px;
        }
        return found;
    }

    gl::RecordingDevice device;
    assets::MeshLibrary library = test_library();
    TestWorld world;
    ecs::Entity box, camera;
    std::vector<ecs::Entity> lights;
    TransformSystem transforms;
    Extractor extractor;
    SceneSnapshot snapshot;
    FrameReport report;
    std::optional<GpuScene> gpu;
    std::optional<shadow::ShadowSystem> system{std::in_place, device};
    std::optional<shadow::FittedViews> stages;
};

TEST_F(CoreStages, AreTheSystemsOwn) {
    History history;
    Fits fits;
    std::size_t views = 0;
    for (int frame = 0; frame < 80; ++frame) {
        world.move(camera, {1.0 + 0.05 * frame, 4.0, 12.0 - 0.1 * frame});
        if (frame > 20) world.move(box, {6.0 - 0.1 * frame, 0.6, 1.0});
        run_system();
        fit_shadows(own_scene().scene(), {}, history, fits);
        ASSERT_EQ(differences(fits), 0) << "frame " << frame;
        views = std::max(views, fits.views().size());
    }
    EXPECT_GE(views, 8u) << "of a sun, a spot, a cube and a wide spot";
    // The judge sees what differs: another camera, another history.
    OwnScene other = own_scene();
    other.cameras[0].position_ws_m.x += 3.0;
    other.cameras[0].position_ws_m.z += 9.0;
    fit_shadows(other.scene(), {}, history, fits);
    EXPECT_GT(differences(fits), 0);
}

TEST_F(CoreStages, SayWhatTheSystemSays) {
    History history;
    Fits fits;
    for (const ecs::Entity light : lights)
        world.registry.patch<LightShadow>(light, [](LightShadow& s) { s.resolution_px = 1u << 20; });
    const shadow::ShadowFrame& frame = run_system();
    OwnScene own = own_scene();
    for (Light& light : own.lights) light.shadow.resolution_px = 1u << 20;
    const gl::DeviceInfo& info = device.info();
    fit_shadows(own.scene(), {.max_map_px = info.max_texture_px, .max_cube_px = info.max_cube_px}, history, fits);
    EXPECT_EQ(differences(fits), 0);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        EXPECT_EQ(fits.lights()[i].status, Status::resolution_clamped);
        EXPECT_EQ(frame.statuses[i].degraded(), Reason::resolution_clamped);
    }
}

}  // namespace
}  // namespace gnomon::core
