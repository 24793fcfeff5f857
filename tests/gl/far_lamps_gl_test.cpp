#include <cmath>
#include <iostream>
#include <random>
#include <sstream>

#include "bench/accuracy/default_limits.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/traced_frame_fixture.h"

/// Lamps from a few metres to ten thousand kilometres away that light the same place as brightly. The farther one
/// stands, the less of a cube's face or of a cone its light falls through.
namespace gnomon {
namespace {

constexpr double kLit_lx = 100.0;
const glm::dvec3 kToLamp = glm::normalize(glm::dvec3(-0.526, 0.789, 0.316));

class FarLampWorld : public TracedFrameTest {
protected:
    /// Builds a ground, `half_m` to each side, with things of several sizes on it, and a camera.
    void build(double half_m, int things) {
        start_anew();
        settings.viewport_px = {240, 136};
        place(add_analysed(game::make_box({-half_m, -0.5, -half_m}, {half_m, 0.0, half_m})));
        std::mt19937 random(7);
        std::uniform_real_distribution<double> part(0.0, 1.0);
        for (int i = 0; i < things; ++i) {
            const glm::dvec3 at = 0.8 * half_m * glm::dvec3(2.0 * part(random) - 1.0, 0.0, 2.0 * part(random) - 1.0);
            const glm::dvec3 size(0.4 + part(random), 0.5 + 2.0 * part(random), 0.6);
            place(add_analysed(game::make_box(at, at + std::sqrt(0.25 * half_m) * size)));
        }
        const glm::dvec3 from_m(0.6 * half_m, 0.6 * half_m, 0.9 * half_m);
        add_camera({.fov_y_rad = 0.8, .near_m = 0.05, .far_m = 1000.0}, from_m, -from_m);
    }
    ecs::Entity add_lamp(LightKind kind, double distance_m, const LightShadow& shadow = {}) {
        return add_light({.kind = kind,
                          .intensity = static_cast<float>(kLit_lx * distance_m * distance_m),
                          .range_m = 0.0f,
                          .inner_cone_rad = 0.4f,
                          .outer_cone_rad = 0.5f},
                         kToLamp * distance_m, -kToLamp, shadow);
    }
    bool is_aimed() { return frame().fit_history().lights.at(0).aim.used; }
};

class FarLamps : public FarLampWorld, public ::testing::WithParamInterface<LightKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, FarLamps, ::testing::Values(LightKind::point, LightKind::spot),
                         [](const auto& test) { return std::string(shadow::light_kind_row(test.param).name); });

TEST_P(FarLamps, KeepTheDefaultsWordAtAnyDistance) {
    for (const double half_m : {4.0, 30.0}) {
        for (const double distance_m : {60.0, 1.6e3, 1e5, 1e7}) {
            std::ostringstream where;
            where << half_m << " m, lamp at " << distance_m << " m";
            SCOPED_TRACE(where.str());
            build(half_m, half_m > 10.0 ? 25 : 4);
            add_lamp(GetParam(), distance_m);
            draw();
            const Judged judged = judge();
            std::cout << where.str() << ": " << judged.metrics.wrong << " of " << judged.metrics.scored << " wrong, "
                      << judged.truly_dark << " dark\n";
            EXPECT_LE(judged.metrics.fraction(judged.metrics.wrong), bench::kMostWrongByDefault);
            EXPECT_GT(judged.truly_dark, judged.metrics.scored / 50) << "nothing to lose";
            const double aims_from_m = GetParam() == LightKind::point ? 1e3 : 1e4;
            if (distance_m > aims_from_m || distance_m < 1e3) {
                EXPECT_EQ(is_aimed(), distance_m > aims_from_m);
            }
        }
    }
}

// A point that has a flat map is read by all that read a spot's: one filter for each way to read a map.
TEST_F(FarLampWorld, APointIsShadowedByFiltersOfEveryStorage) {
    constexpr double kMostWrong = 0.001;  // at edges; without a shadow it were all that is dark
    for (const ShadowFilter filter :
         {ShadowFilter::hard, ShadowFilter::pcss, ShadowFilter::moments, ShadowFilter::exact}) {
        SCOPED_TRACE(shadow::filter_row(filter).name);
        build(4.0, 4);
        add_lamp(LightKind::point, 1e5, {.filter = filter, .resolution_px = 1024});
        draw();
        EXPECT_TRUE(is_aimed());
        const Judged judged = judge();
        EXPECT_LE(judged.metrics.fraction(judged.metrics.wrong), kMostWrong);
        EXPECT_GT(judged.truly_dark, judged.metrics.scored / 50) << "nothing to lose";
    }
}

TEST_P(FarLamps, ThatStandStillHaveTheirMapsDrawnOnce) {
    build(4.0, 4);
    add_lamp(GetParam(), 1e5);
    for (int i = 0; i < 3; ++i) draw();
    EXPECT_EQ(frame().report().lights.at(0).counts.views, 1u);
    EXPECT_EQ(frame().report().lights.at(0).counts.views_drawn, 0u);
}

TEST_P(FarLamps, SayWhereFloatsTellNothingApart) {
    build(4.0, 4);
    add_lamp(GetParam(), 1e7);
    draw();
    EXPECT_NE(frame().report().lights.at(0).reason, Reason::depth_coarse);
    build(4.0, 4);
    // Floats resolve depths from there to the ground only to metres.
    place(add_analysed(game::make_box(glm::dvec3(-0.1), glm::dvec3(0.1))), {.translation_m = kToLamp * 9e6});
    add_lamp(GetParam(), 1e7);
    draw();
    EXPECT_EQ(frame().report().lights.at(0).reason, Reason::depth_coarse);
}

}  // namespace
}  // namespace gnomon
