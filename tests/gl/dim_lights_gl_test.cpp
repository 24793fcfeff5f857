#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/gl/frame_fixture.h"

/// The one rule that may change the picture: by no more than a step.
namespace gnomon {
namespace {

class DimLightsGl : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        settings.viewport_px = {160, 120};
        assets::Material matt_one;
        matt_one.metallic = 0.0f;
        const std::uint32_t matt = add_material(matt_one);
        const std::uint32_t plane = add_mesh(game::make_card({0, 0, 0}, {0, 0, 10}, {10, 0, 0}), matt);
        const std::uint32_t box = add_mesh(game::make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), matt);
        place(plane, {}, false);
        place(box, {.translation_m = {0.0, 1.0, 0.0}});
        add_camera({}, {0.0, 5.0, 9.0}, {0.0, -5.0, -9.0});
    }
    /// Lights of this much each, from all around.
    void add_lights(float candela) {
        for (const ecs::Entity light : lights) world.destroy(light);
        lights.clear();
        Light lamp;
        lamp.intensity = candela;
        for (const double x : {-4.0, -1.0, 2.0, 5.0}) lights.push_back(add_light(lamp, {x, 6.0, 2.0}, {0, -1, 0}));
    }
    std::size_t left_out() {
        return static_cast<std::size_t>(
            std::count_if(frame().report().lights.begin(), frame().report().lights.end(),
                          [](const LightReport& l) { return l.reason == Reason::below_display_step; }));
    }
    std::vector<std::uint8_t> drawn(bool with_rule, bool shadows = true) {
        settings.leave_out_dim_lights = with_rule;
        settings.shadows = shadows;
        draw();
        return picture();
    }
    static int most_apart(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
        int most = 0;
        for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(int{a[i]} - int{b[i]}));
        return most;
    }
    std::vector<ecs::Entity> lights;
};

TEST_F(DimLightsGl, NoPixelChangesByMoreThanAStepWhateverIsLeftOut) {
    std::size_t some = 0;
    for (float candela = 64.0f; candela > 0.01f; candela *= 0.7071f) {
        add_lights(candela);
        const std::vector<std::uint8_t> with = drawn(true);
        some += left_out() > 0 ? 1 : 0;
        EXPECT_LE(most_apart(with, drawn(false)), 1) << candela << " cd, " << left_out() << " left out";
    }
    EXPECT_GT(some, 3u);
}

TEST_F(DimLightsGl, AnExposureThatFollowsThePictureLeavesFaintLightsOut) {
    settings.exposure_ev.reset();
    settings.repeatable = true;
    add_lights(1.0e-3f);
    Light sun;
    sun.kind = LightKind::directional;
    sun.intensity = 1.0e3f;
    lights.push_back(add_light(sun, {0, 5, 0}, {1, -2, -1}));
    drawn(true);
    EXPECT_EQ(left_out(), 0u) << "nothing is known yet";
    const std::vector<std::uint8_t> with = drawn(true);
    EXPECT_EQ(left_out(), 4u);
    for (const LightReport& light : frame().report().lights)
        if (light.kind == LightKind::point) {
            EXPECT_GT(light.why.display_steps.value(), 0.0);
        }
    EXPECT_LE(most_apart(with, drawn(false)), 1);
    // Ten thousand times as bright, they are too bright to be left out.
    for (const ecs::Entity light : lights)
        if (world.get<Light>(light)->kind == LightKind::point)
            world.patch<Light>(light, [](Light& l) { l.intensity *= 1.0e4f; });
    for (int i = 0; i < 3; ++i) drawn(true);
    EXPECT_EQ(left_out(), 0u);
}

TEST_F(DimLightsGl, ShadowsThatAreSeenChangeMore) {
    add_lights(64.0f);
    EXPECT_GT(most_apart(drawn(true), drawn(false, false)), 1) << "the comparison sees shadows";
    EXPECT_EQ(left_out(), 0u);
}

}  // namespace
}  // namespace gnomon
