#include "systems/shadow/dim_lights.h"

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
    /// Candela of a lamp there that adds no more than that many steps, by the report of a brighter one.
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
    for (std::uint64_t i = 0; i <= shadow::MapStore::kHoldFrames + 1; ++i) step();
    EXPECT_TRUE(left_out("dim"));
    EXPECT_NEAR(light("dim").why.display_steps.value(), 0.1, 1.0e-5);
    EXPECT_THAT(depth_passes(), IsEmpty());
    EXPECT_THAT(map_labels(device), Not(Contains("shadow map dim")));
    EXPECT_EQ(light("dim").bytes, 0u);
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
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.economy = false; });
    step();
    EXPECT_FALSE(left_out("lamp"));
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.economy = true; });
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
