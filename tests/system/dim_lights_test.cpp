#include "systems/shadow/culling/contribution_culling.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "systems/lighting/lighting_system.h"
#include "tests/system/frame_fixture.h"

/// Lights that are too dim for their shadows to be seen, at a known exposure.
namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

class DimLightsTest : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        library.materials[0].metallic = 0.0f;  // rough, white
        start();
        stage = world.add_stage();
        settings.exposure_ev = 10.0f;
    }
    ecs::Entity add_lamp(const std::string& name, float candela) {
        const ecs::Entity lamp = world.add_light(LightKind::spot, {3.0, 9.0, 1.0}, name);
        set(lamp, candela);
        return lamp;
    }
    void set(ecs::Entity lamp, float candela) {
        world.registry.patch<Light>(lamp, [candela](Light& l) { l.intensity = candela; });
    }
    /// Returns the candela of a lamp there that adds `steps` display steps at most, by the report of a brighter one.
    float candela_of(double steps) {
        const ecs::Entity lamp = add_lamp("probe", 1000.0f);
        step();
        const double most = light("probe").why.display_steps.value();
        world.registry.destroy(lamp);
        return static_cast<float>(1000.0 * steps / most);
    }
    bool left_out(const std::string& name) const { return light(name).reason == Reason::below_display_step; }
    TestWorld::Stage stage;
};

TEST_F(DimLightsTest, OneThatRoundsAwayCostsNothing) {
    add_lamp("dim", candela_of(0.1));
    for (std::uint64_t i = 0; i <= shadow::MapCache::kHoldFrames + 1; ++i) step();
    EXPECT_TRUE(left_out("dim"));
    EXPECT_NEAR(light("dim").why.display_steps.value(), 0.1, 1.0e-5);
    EXPECT_THAT(depth_passes(), IsEmpty());
    EXPECT_THAT(map_labels(device), Not(Contains("shadow map dim")));
    EXPECT_EQ(light("dim").counts.bytes, 0u);
}

TEST_F(DimLightsTest, ABrighterOneIsShadowed) {
    add_lamp("bright", candela_of(0.6));
    step();
    EXPECT_EQ(light("bright").reason, Reason::none);
}

TEST_F(DimLightsTest, SeveralAreLeftOutAsLongAsTheirSumIsSmallTheDimmestFirst) {
    const float fifth = candela_of(0.2);
    add_lamp("third", 1.01f * fifth);
    add_lamp("first", 0.5f * fifth);
    add_lamp("second", fifth);
    step();
    EXPECT_TRUE(left_out("first"));
    EXPECT_TRUE(left_out("second"));
    EXPECT_FALSE(left_out("third")) << "all three would be half a step";
}

TEST_F(DimLightsTest, OneBetweenTheTwoBoundsStaysWhatItIs) {
    const float between = candela_of(0.45);
    const ecs::Entity lamp = add_lamp("lamp", between);
    step();
    EXPECT_FALSE(left_out("lamp")) << "it was not before";
    set(lamp, 0.5f * between);
    step();
    EXPECT_TRUE(left_out("lamp"));
    set(lamp, between);
    step();
    EXPECT_TRUE(left_out("lamp")) << "it was before";
    set(lamp, 1.2f * between);
    step();
    EXPECT_FALSE(left_out("lamp"));
}

TEST_F(DimLightsTest, NoneIsWhereTheExposureIsNotKnownOrItIsNotWanted) {
    const ecs::Entity lamp = add_lamp("lamp", candela_of(0.1));
    settings.exposure_ev.reset();
    step();
    EXPECT_FALSE(left_out("lamp"));
    EXPECT_FALSE(light("lamp").why.display_steps);
    settings.exposure_ev = 10.0f;
    settings.leave_out_dim_lights = false;
    step();
    EXPECT_FALSE(left_out("lamp"));
    settings.leave_out_dim_lights = true;
    edit_light(world.registry, lamp, [](ShadowTuning& t) { t.reuse.economy = false; });
    step();
    EXPECT_FALSE(left_out("lamp"));
    edit_light(world.registry, lamp, [](ShadowTuning& t) { t.reuse.economy = true; });
    step();
    EXPECT_TRUE(left_out("lamp"));
}

TEST_F(DimLightsTest, AnExposureThatShowsMoreBringsItsShadowBack) {
    add_lamp("lamp", candela_of(0.1));
    step();
    EXPECT_TRUE(left_out("lamp"));
    settings.exposure_ev = 5.0f;
    step();
    EXPECT_FALSE(left_out("lamp"));
}

TEST_F(DimLightsTest, AGlossyReceiverOrOneThatTouchesItNeedsTheShadow) {
    library.materials[0].roughness = 0.1f;
    start();
    const float rough = candela_of(0.1);
    library.materials[0].roughness = 1.0f;
    start();
    EXPECT_GT(candela_of(0.1), 1000.0f * rough);
    const ecs::Entity lamp = add_lamp("lamp", 1.0e-9f);
    world.registry.patch<Transform>(lamp, [](Transform& t) { t.translation_m = {0, 1.2, 0}; });
    step();
    EXPECT_FALSE(left_out("lamp")) << "it stands in the box";
}

/// The exposure follows from the picture, and comes back from the device.
class MeasuredExposure : public DimLightsTest {
protected:
    void SetUp() override {
        DimLightsTest::SetUp();
        settings.repeatable = true;
    }
    /// Sets the exposure that the device will read back from now on.
    void answer(double exposure) {
        const float scale = static_cast<float>(exposure);
        const auto bytes = std::as_bytes(std::span(&scale, 1));
        device.script_readback("exposure to read", {bytes.begin(), bytes.end()});
    }
    /// Returns the exposure at which a lamp of `candela` adds `steps` display steps.
    double exposure_of(double steps, float candela) {
        settings.exposure_ev = 10.0f;
        return steps / 0.1 * static_cast<double>(lighting::exposure_scale(10.0f)) *
               static_cast<double>(candela_of(0.1) / candela);
    }
    void follow_the_picture() { settings.exposure_ev.reset(); }
    template <class Command>
    std::size_t recorded() const {
        const auto& all = frame->commands().commands;
        return static_cast<std::size_t>(std::count_if(
            all.begin(), all.end(), [](const gl::Command& c) { return std::holds_alternative<Command>(c); }));
    }
    static constexpr float kBright_cd = 1.0e4f, kFaint_cd = 1.0f;
};

TEST_F(MeasuredExposure, CostsNothingWhereNoLightIsFaintBesideAnother) {
    follow_the_picture();
    add_lamp("one", kFaint_cd);
    for (int i = 0; i < 2; ++i) step();
    add_lamp("other", 1000.0f * kFaint_cd);
    for (int i = 0; i < 2; ++i) {
        step();
        EXPECT_EQ(recorded<gl::Dispatch>() + recorded<gl::CopyBuffer>(), 0u);
    }
    for (const gl::ResourceCall& call : device.resource_calls()) {
        EXPECT_NE(call.kind, gl::ResourceCall::Kind::read_buffer);
        EXPECT_NE(call.label.rfind("exposure", 0), 0u) << call.label;
    }
}

TEST_F(MeasuredExposure, LeavesAFaintLightOutOnceItIsKnown) {
    answer(exposure_of(0.09, kFaint_cd));
    follow_the_picture();
    add_lamp("bright", kBright_cd);
    add_lamp("faint", kFaint_cd);
    step();
    EXPECT_FALSE(left_out("faint"));
    EXPECT_FALSE(light("faint").why.display_steps) << "not known yet";
    EXPECT_EQ(recorded<gl::Dispatch>(), 1u);
    EXPECT_EQ(recorded<gl::CopyBuffer>(), 1u);
    step();
    EXPECT_TRUE(left_out("faint"));
    EXPECT_FALSE(left_out("bright"));
    const double most = 0.09 * lighting::ExposureMeter::kMostGrowth;
    EXPECT_GE(light("faint").why.display_steps.value(), 0.999 * most);
    EXPECT_LE(light("faint").why.display_steps.value(), 1.2 * most) << "rounded up to a quarter stop";
    for (int i = 0; i < 3; ++i) step();
    EXPECT_TRUE(left_out("faint"));
}

TEST_F(MeasuredExposure, IsReckonedWithTwoStopsMore) {
    answer(exposure_of(0.13, kFaint_cd));  // four times that is more than half a step
    follow_the_picture();
    add_lamp("bright", kBright_cd);
    add_lamp("faint", kFaint_cd);
    for (int i = 0; i < 4; ++i) step();
    EXPECT_FALSE(left_out("faint"));
    EXPECT_TRUE(light("faint").why.display_steps.has_value());
}

TEST_F(MeasuredExposure, ThatShowsMoreBringsTheShadowBack) {
    const double dark = exposure_of(0.02, kFaint_cd);
    answer(dark);
    follow_the_picture();
    add_lamp("bright", kBright_cd);
    add_lamp("faint", kFaint_cd);
    for (int i = 0; i < 3; ++i) step();
    EXPECT_TRUE(left_out("faint"));
    answer(100.0 * dark);
    for (int i = 0; i < 2; ++i) step();
    EXPECT_FALSE(left_out("faint"));
}

TEST_F(MeasuredExposure, ThatTremblesLeavesTheFrameStill) {
    const double exposure = exposure_of(0.02, kFaint_cd);
    follow_the_picture();
    add_lamp("bright", kBright_cd);
    add_lamp("faint", kFaint_cd);
    answer(exposure);
    for (std::uint64_t i = 0; i < 2 * shadow::MapCache::kHoldFrames; ++i) step();
    EXPECT_TRUE(frame->report().still);
    for (const double factor : {0.8, 1.0, 0.7, 0.95}) {
        answer(factor * exposure);
        for (int i = 0; i < 2; ++i) {
            step();
            EXPECT_TRUE(frame->report().still) << factor;
            EXPECT_TRUE(left_out("faint"));
        }
    }
}

TEST_F(MeasuredExposure, IsNotWaitedForAndNoMoreThanThreeAreUnderWay) {
    answer(exposure_of(0.02, kFaint_cd));
    settings.repeatable = false;
    device.delay_readbacks(5);
    follow_the_picture();
    add_lamp("bright", kBright_cd);
    add_lamp("faint", kFaint_cd);
    std::size_t copies = 0;
    for (int i = 0; i < 6; ++i) {
        step();
        EXPECT_FALSE(left_out("faint")) << i;
        copies += recorded<gl::CopyBuffer>();
    }
    EXPECT_EQ(copies, 3u);
    step();
    EXPECT_TRUE(left_out("faint"));
}

TEST_F(MeasuredExposure, OfARepeatableRunIsKnownInTheNextFrameHoweverLateTheDeviceIs) {
    answer(exposure_of(0.02, kFaint_cd));
    device.delay_readbacks(5);
    follow_the_picture();
    add_lamp("bright", kBright_cd);
    add_lamp("faint", kFaint_cd);
    step();
    EXPECT_FALSE(left_out("faint"));
    step();
    EXPECT_TRUE(left_out("faint"));
}

TEST_F(MeasuredExposure, ThatIsLostOrOfAnotherCameraOrAbsurdLeavesNoLightOut) {
    const double exposure = exposure_of(0.02, kFaint_cd);
    answer(exposure);
    follow_the_picture();
    add_lamp("bright", kBright_cd);
    add_lamp("faint", kFaint_cd);
    for (int i = 0; i < 3; ++i) step();
    ASSERT_TRUE(left_out("faint"));
    device.fail_call(device.calls(), gl::Failure::out_of_memory);
    step();
    EXPECT_FALSE(left_out("faint")) << "lost";
    step();
    EXPECT_TRUE(left_out("faint"));
    world.registry.destroy(stage.camera);
    world.add_camera({0, 4, 8.5}, {0, 0, 0});
    step();
    EXPECT_FALSE(left_out("faint")) << "of another camera";
    step();
    EXPECT_TRUE(left_out("faint"));
    for (const double absurd : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
        answer(absurd);
        for (int i = 0; i < 2; ++i) step();
        EXPECT_FALSE(left_out("faint")) << absurd;
    }
}

TEST(MostReflected, HoldsTheTermsOfTheShader) {
    const auto reflected = [](float roughness, float metallic, float colour) {
        assets::Material material;
        material.base_colour = glm::vec4(colour);
        material.metallic = metallic;
        material.roughness = roughness;
        return most_reflected(material);
    };
    EXPECT_NEAR(reflected(1.0f, 0.0f, 1.0f), 1.5 / 3.14159265, 1.0e-6);
    EXPECT_NEAR(reflected(1.0f, 1.0f, 1.0f), 0.5 / 3.14159265, 1.0e-6);
    EXPECT_GT(reflected(0.5f, 1.0f, 0.1f), reflected(0.6f, 1.0f, 0.1f));
    EXPECT_TRUE(std::isfinite(reflected(0.0f, 0.0f, 1.0f)));
}

}  // namespace
}  // namespace gnomon
