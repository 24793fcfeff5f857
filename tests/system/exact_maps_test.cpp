#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "systems/shadow/request/map_textures.h"
#include "systems/shadow/request/ray_limit.h"
#include "tests/system/frame_fixture.h"
#include "tests/system/passes.h"

// Maps of filter=exact, which say where rays are needed: what they hold, when they are drawn, and what happens without.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr std::uint32_t kSize_px = 256;
/// Two depths, where sheets end and how far they depart; and, in one layer, which triangle is shown.
constexpr std::uint64_t kTexelBytes = 4 + 4 + 8, kTriangleBytes = 8;

class ExactMaps : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
    }
    ecs::Entity add_light(LightKind kind, const std::string& name) {
        const ecs::Entity light = world.add_light(kind, kLightPlace_m, name);
        set(light, [](LightShadow&) {});
        return light;
    }
    template <class Change>
    void set(ecs::Entity light, Change change) {
        edit_light(world.registry, light, [](LightShadow& s) {
            s.filter = ShadowFilter::exact;
            s.resolution_px = kSize_px;
        });
        edit_light(world.registry, light, change);
    }
    /// Labels of the targets of the last frame's passes that begin so.
    std::vector<std::string> drawn(const std::string& kind = "shadow map") const {
        std::vector<std::string> labels;
        for (const Pass& pass : passes_of(frame->commands(), device)) {
            const std::string& label = device.target(pass.begin.target)->label;
            if (label.starts_with(kind)) labels.push_back(label);
        }
        return labels;
    }
    TestWorld::Stage stage;
};

TEST_F(ExactMaps, AreDrawnNearestNextAndBounds) {
    add_light(LightKind::spot, "lamp");
    step();
    EXPECT_THAT(drawn(), ElementsAre("shadow map lamp", "shadow map lamp, second", "shadow map lamp, bounds"));
    EXPECT_EQ(light("lamp").counts.bytes, kSize_px * kSize_px * (kTexelBytes + kTriangleBytes));
    EXPECT_EQ(light("lamp").counts.texels, kSize_px * kSize_px);
    EXPECT_EQ(light("lamp").state, LightState::rendered);
    EXPECT_EQ(light("lamp").predicted_error_px, 0.0);
    EXPECT_TRUE(light("lamp").keeps_max_error);
}

TEST_F(ExactMaps, ShareOneLayerOfTrianglesAmongAllViews) {
    add_light(LightKind::point, "bulb");
    step();
    EXPECT_EQ(light("bulb").counts.bytes, kSize_px * kSize_px * (6 * kTexelBytes + kTriangleBytes));
    ASSERT_GT(light("bulb").counts.views_drawn, 1u);
    EXPECT_EQ(drawn().size(), 3 * std::size_t{light("bulb").counts.views_drawn});
}

TEST_F(ExactMaps, OfAStillSceneAreKeptWhereverTheCameraStands) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp");
    set(lamp, [](ShadowTuning& t) { t.cascades.fit = ShadowFit::stable; });
    step();
    step();
    EXPECT_THAT(drawn(), IsEmpty());
    EXPECT_EQ(light("lamp").state, LightState::reused);
    world.move(stage.camera, {0.01, 4, 8});
    step();
    EXPECT_THAT(drawn(), IsEmpty());
}

TEST_F(ExactMaps, AreDrawnAnewWhereACasterMovedEvenWhereOthersMayWait) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp");
    set(lamp, [](LightShadow& s) { s.refresh_error_px = 1000.0f; });
    step();
    world.move(stage.box, {0.001, 1, 0});
    step();
    EXPECT_THAT(drawn(), SizeIs(3)) << "of casters as they were nothing is certain";
}

TEST_F(ExactMaps, AreOneOfASunUnlessItSaysOtherwise) {
    const ecs::Entity sun = add_light(LightKind::directional, "sun");
    step();
    EXPECT_EQ(light("sun").counts.texels, kSize_px * kSize_px);
    set(sun, [](LightShadow& s) { s.cascades = 3; });
    step();
    EXPECT_EQ(light("sun").counts.texels, 3 * kSize_px * kSize_px);
}

TEST_F(ExactMaps, AreNotMadeForASunSeenFromAnEye) {
    const ecs::Entity sun = add_light(LightKind::directional, "sun");
    set(sun, [](ShadowTuning& t) {
        t.projection.kind = LightProjection::perspective;
        t.projection.eye_distance_m = 50.0f;
    });
    step();
    EXPECT_THAT(drawn(), IsEmpty());
    EXPECT_EQ(light("sun").counts.bytes, 0u);
    EXPECT_EQ(light("sun").state, LightState::rendered);
    EXPECT_TRUE(light("sun").keeps_max_error) << "rays alone";
    EXPECT_THAT(map_labels(device, "ray "), Not(IsEmpty()));
}

TEST_F(ExactMaps, AreDoneWithoutWhereThereIsNoRoom) {
    for (const char* what :
         {"shadow map lamp", "shadow map lamp, triangles", "shadow map lamp, second", "shadow map lamp, bounds"}) {
        SCOPED_TRACE(what);
        device.fail_label(what, gl::Failure::out_of_memory);
        const ecs::Entity lamp = add_light(LightKind::spot, "lamp");
        step();
        EXPECT_THAT(drawn(), IsEmpty());
        EXPECT_EQ(light("lamp").state, LightState::degraded);
        EXPECT_EQ(light("lamp").reason, Reason::map_allocation_failed);
        EXPECT_TRUE(light("lamp").keeps_max_error) << "rays do without";
        EXPECT_THAT(compiled_labels(device), Contains(HasSubstr("exact")));
        device.stop_failing();
        for (std::uint64_t i = 0; i < shadow::MapCache::kRetryFrames; ++i) step();
        EXPECT_THAT(drawn(), SizeIs(3));
        EXPECT_EQ(light("lamp").state, LightState::rendered);
        world.registry.destroy(lamp);
        step();
        EXPECT_THAT(map_labels(device), IsEmpty());
    }
}

/// Sets 64 x 36 pixels against 2048 x 2048 texels.
TEST_F(ExactMaps, ThatChangeAndCostMoreThanRaysForAllPixelsAreLeftToThem) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp");
    set(lamp, [](LightShadow& s) { s.resolution_px = 2048; });
    step();
    EXPECT_THAT(drawn(), SizeIs(3)) << "nothing is known to move";
    for (int i = 1; i <= 3; ++i) {
        world.move(stage.box, {0.1 * i, 1, 0});
        step();
        EXPECT_THAT(drawn(), IsEmpty());
        EXPECT_EQ(light("lamp").state, LightState::rendered);
        EXPECT_EQ(light("lamp").reason, Reason::rays_cheaper);
        EXPECT_EQ(frame->report().views_of(light("lamp"))[0].reason, Reason::rays_cheaper);
        EXPECT_TRUE(light("lamp").keeps_max_error);
    }
    step();
    EXPECT_THAT(drawn(), SizeIs(3)) << "it stands";
    EXPECT_EQ(light("lamp").reason, Reason::none);
    step();
    EXPECT_THAT(drawn(), IsEmpty());
    EXPECT_EQ(light("lamp").state, LightState::reused);
    // Few texels are worth it.
    set(lamp, [](LightShadow& s) { s.resolution_px = 16; });
    step();
    world.move(stage.box, {0.0, 1, 0});
    step();
    EXPECT_THAT(drawn(), SizeIs(3));
}

TEST_F(ExactMaps, GiveWayToFilteredOnesByWhatTheyMeanAndComeBackWithRoomToSpare) {
    add_light(LightKind::spot, "bright");
    const ecs::Entity dim = add_light(LightKind::spot, "dim");
    world.registry.patch<Light>(dim, [](Light& l) { l.intensity *= 0.5f; });
    step();
    const auto pixels = [&] { return shadow::lookup_pixels(frame->snapshot(), frame->snapshot().lights[0]); };
    ASSERT_GT(pixels(), 100.0);
    const double each = pixels() * shadow::kUncertainShare;
    settings.shadow_budget.rays = static_cast<std::uint64_t>(1.9 * each);
    step();
    EXPECT_EQ(light("bright").reason, Reason::content_unchanged);
    EXPECT_EQ(light("dim").state, LightState::degraded);
    EXPECT_EQ(light("dim").reason, Reason::ray_budget);
    EXPECT_GT(light("dim").predicted_error_px, 0.0);
    EXPECT_THAT(drawn("shadow map dim"), ElementsAre("shadow map dim")) << "as triangles have it";
    settings.shadow_budget.rays = static_cast<std::uint64_t>(2.1 * each);
    step();
    EXPECT_EQ(light("dim").reason, Reason::ray_budget) << "there is room, but not a quarter more";
    settings.shadow_budget.rays = static_cast<std::uint64_t>(2.3 * each);
    step();
    EXPECT_EQ(light("dim").state, LightState::rendered);
    EXPECT_EQ(light("dim").reason, Reason::none);
    settings.shadow_budget.rays = 1;
    step();
    EXPECT_EQ(light("bright").reason, Reason::ray_budget);
    EXPECT_EQ(light("dim").reason, Reason::ray_budget);
    step();
    EXPECT_THAT(map_labels(device, "ray "), IsEmpty()) << "nobody asks";
}

TEST_F(ExactMaps, AreDoneWithoutWhereTheirProgramsFail) {
    device.fail_label("sheet contours", gl::Failure::compile_failed);
    add_light(LightKind::spot, "lamp");
    step();
    EXPECT_THAT(drawn(), IsEmpty());
    EXPECT_EQ(light("lamp").state, LightState::degraded);
    EXPECT_EQ(light("lamp").reason, Reason::depth_program_failed);
    EXPECT_TRUE(light("lamp").keeps_max_error);
    device.stop_failing();
    for (std::uint64_t i = 0; i < Retry::kFrames; ++i) step();
    EXPECT_THAT(drawn(), SizeIs(3));
}

}  // namespace
}  // namespace gnomon
