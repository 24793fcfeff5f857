#include "systems/shadow/shadow_system.h"
#include "tests/system/frame_fixture.h"

/// A frame in which nothing changed: what the stages found in the last one stands, and no instance is looked at.
namespace gnomon {
namespace {

using ::testing::IsEmpty;

class StillFrames : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        sun = world.add_light(LightKind::directional, kLightPlace_m, "sun");
        world.add_light(LightKind::spot, kLightPlace_m, "spot");
        world.add_light(LightKind::point, {0, 4, 0}, "point");
    }
    /// Frames until one stands still; 0: none did.
    int settle() {
        constexpr int kMost = 2 * static_cast<int>(shadow::MapCache::kHoldFrames);  // what anything counts up to
        for (int i = 1; i <= kMost; ++i)
            if (step().still) return i;
        return 0;
    }
    TestWorld::Stage stage;
    ecs::Entity sun;
};

TEST_F(StillFrames, ComeOnceFitsHoldWhatTheyHold) {
    EXPECT_GT(settle(), 1) << "the first frame has nothing to stand on";
    for (int i = 0; i < 200; ++i) EXPECT_TRUE(step().still) << i;
    EXPECT_THAT(depth_passes(), IsEmpty());
    EXPECT_EQ(light("sun").state, LightState::reused);
    EXPECT_STREQ(reason_code(light("sun").reason), "content_unchanged");
    EXPECT_GT(light("sun").counts.views, 0u);
    EXPECT_GT(light("sun").counts.bytes, 0u);
}

TEST_F(StillFrames, EndWithWhateverChanges) {
    const std::vector<std::pair<const char*, std::function<void()>>> changes = {
        {"a caster", [&] { world.move(stage.box, {0.1, 1, 0}); }},
        {"the camera", [&] { world.move(stage.camera, {0, 4, 8.1}); }},
        {"a light", [&] { world.registry.patch<Light>(sun, [](Light& l) { l.intensity *= 2.0f; }); }},
        {"a setting", [&] { world.registry.patch<LightShadow>(sun, [](LightShadow& s) { s.cascades = 2; }); }},
        {"the picture's size", [&] { settings.viewport_px.x += 64; }},
        {"shadows", [&] { settings.shadows = !settings.shadows; }},
        {"the world", [&] { world.add_mesh(kBox, {2, 1, 0}, true); }},
    };
    for (const auto& [what, change] : changes) {
        ASSERT_GT(settle(), 0) << "before " << what;
        change();
        EXPECT_FALSE(step().still) << what;
    }
    EXPECT_GT(settle(), 0);
}

TEST_F(StillFrames, NeverComeWhereALightAsksForAllToBeDrawn) {
    edit_light(world.registry, sun, [](ShadowTuning& t) { t.reuse.economy = false; });
    EXPECT_EQ(settle(), 0);
    EXPECT_GT(light("sun").counts.views_drawn, 0u);
}

TEST_F(StillFrames, FrozenCamerasCountAsTheCamerasThatTheyAre) {
    ASSERT_GT(settle(), 0);
    settings.freeze_fits = true;
    step();
    world.move(stage.camera, {1, 4, 8});
    EXPECT_FALSE(step().still) << "the picture has moved";
    ASSERT_GT(settle(), 0);
    settings.freeze_fits = false;
    EXPECT_FALSE(step().still) << "the fits go where the picture is";
}

/// Gives lights numbers as an engine without this registry may: in any way, and to some none at all.
TEST_F(StillFrames, TakeLightsOfAnyNumber) {
    step();
    SceneSnapshot scene = frame->snapshot();
    ASSERT_GT(scene.lights.size(), 1u);
    scene.lights[0].entity = {};
    scene.lights[1].entity = {0x7fffffffu, 3};
    auto gpu = GpuScene::create(device, library);
    ASSERT_TRUE(gpu);
    shadow::ShadowSystem system(device);
    gl::CommandList list;
    FrameReport report;
    gpu.value().update(scene, list);
    system.update(scene, gpu.value(), {}, list, report);
    system.report(scene, {}, report);
    system.commit(scene, true);
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        EXPECT_GT(report.lights[i].counts.views, 0u);
        EXPECT_TRUE(system.maps().find(scene.lights[i].entity));
    }
    EXPECT_FALSE(system.maps().find({0x7fffffffu, 2}));
}

/// Runs the system alone, on a scene that can be taken away from it.
TEST_F(StillFrames, LookAtNoInstance) {
    step();
    SceneSnapshot scene = frame->snapshot();
    auto gpu = GpuScene::create(device, library);
    ASSERT_TRUE(gpu);
    shadow::ShadowSystem system(device);
    gl::CommandList list;
    FrameReport report;
    const auto update = [&] {
        list.clear();
        report.clear();
        gpu.value().update(scene, list);
        scene.changed_instances.clear();
        list.clear();
        system.update(scene, gpu.value(), {}, list, report);
        system.report(scene, {}, report);
        system.commit(scene, true);
    };
    for (int i = 0; i < 120 && !report.still; ++i) update();
    ASSERT_TRUE(report.still);
    const FrameReport before = report;
    const SceneSnapshot whole = scene;
    scene.instances.clear();
    scene.tree = {};
    update();
    EXPECT_TRUE(report.still);
    EXPECT_THAT(list.commands, IsEmpty());
    for (std::size_t i = 0; i < before.lights.size(); ++i) {
        EXPECT_EQ(report.lights[i].state, LightState::reused);
        EXPECT_EQ(report.lights[i].counts.views, before.lights[i].counts.views);
        EXPECT_EQ(report.lights[i].predicted_error_px, before.lights[i].predicted_error_px);
    }
    ++scene.version;
    update();
    EXPECT_FALSE(report.still);
    EXPECT_STREQ(reason_code(report.lights[0].reason), "no_visible_receiver") << "else nothing was taken away";
}

}  // namespace
}  // namespace gnomon
