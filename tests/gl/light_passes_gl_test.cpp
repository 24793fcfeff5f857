#include <array>
#include <cmath>
#include <random>

#include "bench/scaling/many_lights_scene.h"
#include "sample_game/support/scene/spawn_scene.h"
#include "systems/shadow/publish/publish_lights.h"
#include "tests/gl/held_frame_fixture.h"

/// A light's pass leaves out pixels that the light cannot reach, and no other.
namespace gnomon {
namespace {

class LightPasses : public HeldFrameTest {
protected:
    void SetUp() override {
        HeldFrameTest::SetUp();
        settings.viewport_px = {160, 90};
        settings.exposure_ev = 4.0f;
    }
    /// Returns the same frame's picture with every light over the whole picture (not `screen`), or at any depth (not
    /// `depth`).
    std::vector<std::uint8_t> drawn_with(bool screen, bool depth) {
        shadow::LightingInputs handed = inputs();
        const auto size = glm::ivec2(settings.viewport_px);
        for (shadow::LightingLight& light : handed.lights) {
            if (!screen && light.area.screen.width > 0) light.area.screen = {0, 0, size.x, size.y};
            if (!depth) light.area.farthest_depth = 0.0f;
        }
        gl::CommandList list;
        record_picture(handed, list);
        GlTest::run(list);
        return drawn_picture();
    }
};

/// Draws twelve views of a hundred lights, and checks that none misses a pixel. `range_factor`: of the lights' ranges;
/// 0: unlimited. Returns how many passes had bounds.
class ManyPasses : public LightPasses {
protected:
    std::size_t bounded_passes(float range_factor) {
        const game::SpawnedScene spawned = game::spawn_scene(bench::demand_scene(100, 7), world, library);
        for (const game::NamedEntity& lamp : spawned.lights)
            world.patch<Light>(lamp.entity, [&](Light& light) { light.range_m *= range_factor; });
        const ecs::Entity eyes = spawned.cameras.at(0).entity;
        const Camera as_it_is = *world.get<Camera>(eyes);
        std::mt19937_64 random(1);
        const auto number = [&](double from, double to) {
            return from + (to - from) * std::ldexp(static_cast<double>(random() >> 11U), -53);
        };
        std::size_t bounded = 0;
        for (int view = 0; view < 12; ++view) {
            const glm::dvec3 at(number(-40.0, 40.0), number(0.5, 8.0), number(-40.0, 40.0));
            const glm::dvec3 ahead(number(-1.0, 1.0), number(-0.4, 0.1), number(-1.0, 1.0));
            world.emplace<Transform>(eyes, {.translation_m = at, .rotation = looking_along(ahead)});
            world.patch<Camera>(eyes, [&](Camera& camera) {
                camera = as_it_is;
                if (view % 3 == 1) camera.far_m = 60.0;
                if (view % 3 == 2) camera = {.projection = CameraProjection::orthographic, .far_m = 200.0};
            });
            run();
            const std::vector<std::uint8_t> bounds = drawn_picture();
            EXPECT_EQ(drawn_with(true, false), bounds) << "view " << view << ": not at any depth";
            EXPECT_EQ(drawn_with(false, false), bounds) << "view " << view << ": not over the whole picture";
            for (const shadow::LightingLight& light : inputs().lights)
                bounded += light.area.screen.width > 0 && light.area.farthest_depth > 0.0f ? 1 : 0;
        }
        return bounded;
    }
};

TEST_F(ManyPasses, WithRangesGiveTheSamePictureWithoutTheirBounds) { EXPECT_GT(bounded_passes(1.0f), 60u); }

TEST_F(ManyPasses, WithoutRangesGiveTheSamePictureWithoutTheirBounds) { EXPECT_GT(bounded_passes(0.0f), 60u); }

TEST_F(LightPasses, InFogCoverWhatScattersInTheAirToo) {
    place(add_mesh(game::make_box({-9.0, -0.5, -60.0}, {9.0, 0.0, 0.0})), {}, false);
    place(add_mesh(game::make_box({-0.3, 0.0, -20.3}, {0.3, 1.5, -19.7})));
    const ecs::Entity mist = world.create();
    world.emplace<Transform>(mist, {.translation_m = {0.0, 4.0, -20.0}});
    world.emplace<FogVolume>(mist, {.half_extent_m = {9.0, 4.0, 3.0}, .extinction_per_m = 0.2f});
    add_camera({}, {0.0, 3.0, 0.0}, {0.0, 0.0, -1.0});
    Light lamp;
    lamp.kind = LightKind::spot;
    lamp.intensity = 4000.0f;
    lamp.inner_cone_rad = 0.3f;
    lamp.outer_cone_rad = 0.4f;
    for (const bool shadow : {true, false}) {
        const ecs::Entity light = add_light(lamp, {shadow ? -1.0 : 4.0, 7.0, -20.0}, {0.0, -1.0, 0.0});
        if (!shadow) world.remove<LightShadow>(light);
    }
    for (const bool receives : {true, false}) {
        world.patch<FogVolume>(mist, [&](FogVolume& fog) { fog.receives_shadow = receives; });
        run();
        const std::vector<std::uint8_t> lit = drawn_picture();
        EXPECT_EQ(drawn_with(false, false), lit);
        for (const shadow::LightingLight& light : inputs().lights) {
            EXPECT_GT(light.area.screen.height, 20) << "the air above the ground is lit";
            EXPECT_LT(light.area.screen.width, 100);
        }
        // Control: the pass of the ground alone leaves the lit air out.
        shadow::LightingInputs ground = inputs();
        for (shadow::LightingLight& light : ground.lights) light.area.screen.height = 8;
        gl::CommandList list;
        record_picture(ground, list);
        GlTest::run(list);
        EXPECT_NE(drawn_picture(), lit);
    }
}

TEST_F(LightPasses, LeaveOutWhatLiesBehindTheLightsReach) {
    place(add_mesh(game::make_card({0, 0, 0}, {2, 0, 0}, {0, 2, 0})), {}, false);
    add_camera({}, {0.0, 0.0, 5.0}, {0.0, 0.0, -1.0});
    Light lamp;
    lamp.intensity = 100.0f;
    lamp.range_m = 3.0f;
    add_light(lamp, {0.0, 0.0, 2.0}, {0, 0, -1});
    run();
    ASSERT_GT(inputs().lights.at(0).area.screen.width, 0);
    const std::vector<std::uint8_t> lit = drawn_picture();
    EXPECT_EQ(drawn_with(true, false), lit);
    // Control: with a shorter reach of the light the pass leaves the wall out.
    shadow::LightingInputs nearer = inputs();
    nearer.lights[0].area.farthest_depth = inputs().lights[0].area.farthest_depth * 1.5f;
    gl::CommandList list;
    record_picture(nearer, list);
    GlTest::run(list);
    EXPECT_NE(drawn_picture(), lit);
}

class LightPassesOf : public LightPasses, public ::testing::WithParamInterface<LightKind> {};

/// Checks that two draws give the picture of one. The default filter's lights are drawn once until the program of the
/// first of two draws is ready.
TEST_P(LightPassesOf, TwoDrawsGiveThePictureOfOne) {
    place(add_mesh(game::make_box({-8.0, -0.5, -8.0}, {8.0, 0.0, 8.0})), {}, false);
    for (int i = 0; i < 5; ++i)
        place(add_mesh(game::make_sphere(0.4, 12, 8)),
              {.translation_m = {1.3 * i - 2.6, 0.3 + 0.3 * i, 0.4 * i - 0.8}});
    add_camera({}, {0.0, 5.0, 5.0}, {0.0, -1.0, -1.0});
    Light lamp;
    lamp.kind = GetParam();
    lamp.intensity = lamp.kind == LightKind::directional ? 20.0f : 400.0f;
    add_light(lamp, {0.5, 6.0, 0.3}, {0.1, -1.0, -0.2});
    const auto count = [](const gl::CommandList& list) {
        return std::count_if(list.commands.begin(), list.commands.end(),
                             [](const gl::Command& c) { return std::holds_alternative<gl::CopyTexture>(c); });
    };
    const auto draws_of_two = [&](const shadow::LightingInputs& handed) {
        gl::CommandList list;
        record_picture(handed, list);
        GlTest::run(list);
        return count(list);
    };
    most_rows = 1;
    run();
    EXPECT_EQ(count(commands), 0);
    const std::vector<std::uint8_t> one = drawn_picture();
    most_rows = lighting::LightPrograms::kNoLimit;
    EXPECT_EQ(draws_of_two(inputs()), 1);
    EXPECT_EQ(drawn_picture(), one);
    // Control: lights that look edges up in another way give another picture.
    shadow::LightingInputs plain = inputs();
    for (shadow::LightingLight& light : plain.lights) {
        light.row = light.plain.row;
        light.sampler = light.plain.sampler;
    }
    EXPECT_EQ(draws_of_two(plain), 0);
    EXPECT_NE(drawn_picture(), one);
}

std::string kind_name(const ::testing::TestParamInfo<LightKind>& test) {
    const std::array<const char*, 3> names{"directional", "spot", "point"};
    return names.at(static_cast<std::size_t>(test.param));
}

INSTANTIATE_TEST_SUITE_P(Kinds, LightPassesOf,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point), kind_name);

}  // namespace
}  // namespace gnomon
