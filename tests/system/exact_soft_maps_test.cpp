#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "systems/shadow/request/occluder_pyramid.h"
#include "systems/shadow/request/ray_limit.h"
#include "tests/system/frame_fixture.h"
#include "tests/system/passes.h"

// Maps of filter=exact_soft: what they have beside those of exact, when it is made, and what happens without.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::uint32_t kSize_px = 256;
/// 64, 16, 4 and 1 squares along a side.
constexpr std::size_t kLevels = 4;

class ExactSoftMaps : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        stage = world.add_stage();
    }
    ecs::Entity add_light(LightKind kind, const std::string& name, ShadowFilter filter = ShadowFilter::exact_soft) {
        const ecs::Entity light = world.add_light(kind, kLightPlace_m, name);
        set(light, [&](LightShadow& s) { s = {.filter = filter, .resolution_px = kSize_px}; });
        set(light, [](Light& l) { l.source_radius_m = 0.1f, l.sun_radius_rad = 0.01f; });
        return light;
    }
    template <class Change>
    void set(ecs::Entity light, Change change) {
        edit_light(world.registry, light, change);
    }
    std::size_t dispatches() const {
        const auto& commands = frame->commands().commands;
        return static_cast<std::size_t>(std::count_if(commands.begin(), commands.end(), [](const gl::Command& c) {
            return std::holds_alternative<gl::Dispatch>(c);
        }));
    }
    TestWorld::Stage stage;
};

TEST_F(ExactSoftMaps, HaveOneBufferMoreThatIsFilledWhenTheyAreDrawnAndKeptWhenNot) {
    add_light(LightKind::spot, "hard", ShadowFilter::exact);
    step();
    const std::size_t others = dispatches();
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp");
    step();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
    EXPECT_EQ(light("lamp").counts.bytes, light("hard").counts.bytes + shadow::pyramid_bytes(kSize_px, 1));
    EXPECT_EQ(dispatches(), others + kLevels);
    EXPECT_THAT(compiled_labels(device), Contains(HasSubstr("exact_soft")));
    step();
    EXPECT_EQ(dispatches(), others);
    EXPECT_EQ(light("lamp").reason, Reason::content_unchanged);
    set(lamp, [](Light& l) { l.source_radius_m = 0.05f; });
    step();
    EXPECT_EQ(dispatches(), others + kLevels) << "how steep a facet may be follows from the size";
}

TEST_F(ExactSoftMaps, OfAPointAreThoseOfExact) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp");
    set(lamp, [](Light& l) { l.source_radius_m = 0.0f; });  // a sun's size is none of its own
    add_light(LightKind::spot, "hard", ShadowFilter::exact);
    step();
    EXPECT_EQ(light("lamp").counts.bytes, light("hard").counts.bytes);
    EXPECT_THAT(compiled_labels(device), Not(Contains(HasSubstr("exact_soft"))));
    EXPECT_THAT(compiled_labels(device), Not(Contains(HasSubstr("sheet ends"))));
}

TEST_F(ExactSoftMaps, AreDoneWithoutWhereTheirProgramOrTheirBufferFails) {
    device.fail_label("sheet ends", gl::Failure::compile_failed);
    add_light(LightKind::spot, "lamp");
    step();
    EXPECT_EQ(dispatches(), 0u);
    EXPECT_EQ(light("lamp").state, LightState::degraded);
    EXPECT_EQ(light("lamp").reason, Reason::depth_program_failed);
    device.stop_failing();
    for (std::uint64_t i = 0; i < Retry::kFrames; ++i) step();
    EXPECT_EQ(light("lamp").state, LightState::rendered);
    device.fail_label("shadow map other, ends", gl::Failure::out_of_memory);
    add_light(LightKind::point, "other");
    step();
    EXPECT_EQ(light("other").state, LightState::degraded);
    EXPECT_EQ(light("other").reason, Reason::map_allocation_failed);
}

TEST_F(ExactSoftMaps, CountEveryRayInABudgetAndGiveWayToTheFilterOfASourceWithASize) {
    const ecs::Entity lamp = add_light(LightKind::spot, "lamp");
    step();
    const SceneSnapshot& scene = frame->snapshot();
    const double one_ray = shadow::lookup_pixels(scene, scene.lights[0]) * shadow::kUncertainShare;
    settings.shadow_budget.rays = static_cast<std::uint64_t>(15.5 * one_ray);
    step();
    EXPECT_EQ(light("lamp").reason, Reason::ray_budget) << "of 16 for each";
    EXPECT_THAT(compiled_labels(device), Contains(HasSubstr("pcss")));
    set(lamp, [](ShadowTuning& t) { t.kernel.penumbra_rays = 12; });
    step();
    EXPECT_EQ(light("lamp").reason, Reason::none) << "which leaves a quarter more";
}

}  // namespace
}  // namespace gnomon
