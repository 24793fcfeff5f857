#include <functional>

#include "engine/mesh/mesh_shape.h"
#include "gnomon/components.h"
#include "systems/shadow/request/filter_table.h"
#include "tests/system/frame_fixture.h"
#include "tests/system/silent_device.h"
#include "tests/unit/allocation_counter.h"

/// What a frame costs the CPU, as far as it can be tested without a clock's mood.
namespace gnomon {
namespace {

class FrameCost : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
        world.add_light(LightKind::directional, kLightPlace_m, "sun");
        world.add_light(LightKind::spot, kLightPlace_m, "spot");
        world.add_light(LightKind::point, {0, 4, 0}, "point");
    }
    TestWorld::Stage stage;
};

TEST_F(FrameCost, EveryLightIsToldItsOwnTime) {
    world.add_light(LightKind::point, {0, 4, 0}, "plain", false);
    step();
    double sum_us = 0.0;
    for (const char* name : {"sun", "spot", "point"}) {
        EXPECT_GT(light(name).cpu_us, 0.0) << name;
        sum_us += light(name).cpu_us;
    }
    EXPECT_LE(sum_us, frame->report().shadow_cpu_us) << "parts are not more than the whole";
    EXPECT_LT(light("plain").cpu_us, light("sun").cpu_us);
}

TEST_F(FrameCost, TimesAreOfThisFrameAlone) {
    step();
    for (int i = 0; i < 10; ++i) {
        step();
        double sum_us = 0.0;
        for (const LightReport& l : frame->report().lights) sum_us += l.cpu_us;
        EXPECT_LE(sum_us, frame->report().shadow_cpu_us);
    }
}

/// More frames than anything counts: since when a map has not been used, since when something stands still.
constexpr int kWarm = 100;

/// Counts the allocations of the last of `frames` frames, or of all after the hundredth. `edit` changes the world
/// before each.
template <class Edit>
std::size_t allocations_when_warm(std::initializer_list<LightKind> kinds, const FrameSettings& settings, Edit edit,
                                  const assets::MeshLibrary& library = test_library(), int frames = 8) {
    SilentDevice silent;
    auto made = FrameSystem::create(silent, library);
    if (!made) return ~std::size_t{0};
    TestWorld world;
    const TestWorld::Stage parts = world.add_stage();
    // Names that no string holds within itself: a copy of one is an allocation.
    int n = 0;
    const std::string name = "a name of more than a string's own characters, ";
    for (const LightKind kind : kinds) world.add_light(kind, kLightPlace_m, name + std::to_string(n++));
    world.registry.emplace<Name>(parts.camera, {name + "camera"});
    world.registry.emplace<Name>(parts.box, {name + "box"});
    // And the name of an entity that cannot be used, which is in every report.
    const ecs::Entity absurd = world.add_light(LightKind::point, kLightPlace_m, name + "absurd");
    world.registry.patch<Light>(absurd, [](Light& l) { l.intensity = -1.0f; });
    std::size_t allocations = 0;
    for (int i = 0; i < frames; ++i) {
        edit(world, parts, i);
        const std::size_t before = allocation_count();
        made.value()->run(world.registry, settings);
        const std::size_t made_now = allocation_count() - before;
        allocations = i > kWarm ? allocations + made_now : made_now;
    }
    return allocations;
}
const auto still = [](TestWorld&, const TestWorld::Stage&, int) {};
const auto moving = [](TestWorld& world, const TestWorld::Stage& stage, int i) {
    world.move(stage.box, {0.01 * i, 1, 0});
    world.move(stage.camera, {0.01 * i, 4, 8});
};

TEST_F(FrameCost, AStillSceneOfLocalLightsAllocatesNothing) {
    EXPECT_EQ(allocations_when_warm({LightKind::spot, LightKind::point}, settings, still), 0u);
}

TEST_F(FrameCost, NoFilterAllocatesInAStillScene) {
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        const auto filtered = [&](TestWorld& made, const TestWorld::Stage&, int i) {
            if (i > 0) return;
            made.registry.each<LightShadow>([&](ecs::Entity e, const LightShadow&) {
                made.registry.patch<LightShadow>(e, [&](LightShadow& s) { s.filter = row.id, s.resolution_px = 64; });
            });
        };
        const auto kinds = {LightKind::directional, LightKind::spot, LightKind::point};
        EXPECT_EQ(allocations_when_warm(kinds, settings, filtered), 0u) << row.name;
    }
}

TEST_F(FrameCost, LeavingOutDimLightsAllocatesNothingOnceWarm) {
    settings.exposure_ev = 30.0f;
    for (const auto& edit : {std::function<void(TestWorld&, const TestWorld::Stage&, int)>(still), {moving}})
        EXPECT_EQ(allocations_when_warm({LightKind::spot, LightKind::point, LightKind::spot}, settings, edit), 0u);
}

TEST_F(FrameCost, AMovingSceneOfLocalLightsAllocatesNothingOnceWarm) {
    EXPECT_EQ(allocations_when_warm({LightKind::spot, LightKind::point}, settings, moving), 0u);
}

TEST_F(FrameCost, ExactLightsAllocateNothingOnceWarmWhateverTheirRaysMayBe) {
    const auto exact_and_moving = [](TestWorld& made, const TestWorld::Stage& staged, int i) {
        moving(made, staged, i);
        if (i > 0) return;
        made.registry.each<LightShadow>([&](ecs::Entity e, const LightShadow&) {
            made.registry.patch<LightShadow>(
                e, [](LightShadow& s) { s.filter = ShadowFilter::exact, s.resolution_px = 64; });
        });
    };
    const auto kinds = {LightKind::directional, LightKind::spot, LightKind::point};
    for (const std::uint64_t rays : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1500}}) {
        settings.shadow_budget.rays = rays;
        EXPECT_EQ(allocations_when_warm(kinds, settings, exact_and_moving), 0u) << rays;
    }
}

TEST_F(FrameCost, ASunAllocatesNothingOnceWarm) {
    EXPECT_EQ(allocations_when_warm({LightKind::directional}, settings, still), 0u);
    EXPECT_EQ(allocations_when_warm({LightKind::directional}, settings, moving), 0u);
}

TEST_F(FrameCost, LookingForTheNearestReceiverInItsMeshAllocatesNothingOnceWarm) {
    assets::MeshLibrary shaped = test_library();
    for (assets::Mesh& mesh : shaped.meshes) mesh.shape = assets::shape_of(mesh);
    EXPECT_EQ(allocations_when_warm({LightKind::directional, LightKind::spot}, settings, moving, shaped), 0u);
}

const auto box_moves = [](TestWorld& world, const TestWorld::Stage& stage, int i) { world.move(stage.box, {0.001 * i, 1, 0}); };

TEST_F(FrameCost, StillFramesAllocateNothing) {
    const auto kinds = {LightKind::directional, LightKind::spot, LightKind::point};
    EXPECT_EQ(allocations_when_warm(kinds, settings, still, test_library(), 2 * kWarm), 0u);
}

TEST_F(FrameCost, FramesWithOneMoverAllocateNothing) {
    const auto kinds = {LightKind::directional, LightKind::spot, LightKind::point};
    EXPECT_EQ(allocations_when_warm(kinds, settings, box_moves, test_library(), 2 * kWarm), 0u);
}

TEST_F(FrameCost, FramesOfFrozenFitsAllocateNothing) {
    settings.freeze_fits = true;
    for (const auto& edit : {std::function<void(TestWorld&, const TestWorld::Stage&, int)>(still), {moving}})
        EXPECT_EQ(allocations_when_warm({LightKind::directional, LightKind::point}, settings, edit), 0u);
}

TEST_F(FrameCost, ADimmingLightAndAZoomingCameraAllocateNothing) {
    const auto dims = [](TestWorld& made, const TestWorld::Stage& staged, int i) {
        made.registry.each<Light>([&](ecs::Entity e, const Light& l) {
            if (l.intensity > 0.0f) made.registry.patch<Light>(e, [](Light& light) { light.intensity *= 0.99f; });
        });
        made.registry.patch<Camera>(staged.camera, [&](Camera& c) { c.fov_y_rad = 0.9 - 0.001 * i; });
    };
    EXPECT_EQ(allocations_when_warm({LightKind::directional, LightKind::spot}, settings, dims), 0u);
}

TEST_F(FrameCost, AnOrthographicCameraThatWalksAllocatesNothing) {
    const auto walks = [](TestWorld& made, const TestWorld::Stage& staged, int i) {
        if (i == 0)
            made.registry.patch<Camera>(staged.camera, [](Camera& c) { c.projection = CameraProjection::orthographic; });
        made.move(staged.camera, {0.01 * i, 4, 8});
    };
    EXPECT_EQ(allocations_when_warm({LightKind::directional, LightKind::spot}, settings, walks), 0u);
}

TEST_F(FrameCost, FramesWithinABudgetAllocateNothing) {
    const auto kinds = {LightKind::directional, LightKind::spot, LightKind::point, LightKind::spot};
    settings.shadow_budget = {1u << 20, 0.02f};
    for (const auto& edit : {std::function<void(TestWorld&, const TestWorld::Stage&, int)>(still), {box_moves}, {moving}})
        EXPECT_EQ(allocations_when_warm(kinds, settings, edit, test_library(), 2 * kWarm), 0u);
}

}  // namespace
}  // namespace gnomon
