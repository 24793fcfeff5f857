#include <iostream>

#include "tests/gl/traced_frame_fixture.h"

/// Sides of casters that the light passes along: it sees them edge-on, so that rounding decides which way they face.
/// Boxes below a sun at noon have four each.
namespace gnomon {
namespace {

constexpr int kBars = 12;       // so few that lamps see into each gap
constexpr double kBar_m = 0.1;  // a bar, and a gap between two

class BarsAlongLight : public TracedFrameTest, public ::testing::WithParamInterface<LightKind> {
protected:
    void make_grille(bool has_bars) {
        start_anew();
        settings.viewport_px = {480, 270};
        place(add_analysed(game::make_box({-8.0, -0.2, -8.0}, {8.0, 0.0, 8.0})));
        if (has_bars)
            for (int i = -kBars / 2; i < kBars / 2; ++i) {
                const double left_m = 2.0 * i * kBar_m;
                place(add_analysed(game::make_box({left_m, 1.0, -2.0}, {left_m + kBar_m, 1.2, 2.0})));
            }
        add_camera({.fov_y_rad = 0.9, .near_m = 0.1}, {0.0, 6.0, 7.0}, {0.0, -0.64, -0.77});
        add_light_of(GetParam(), {0.0, 4.0, 0.0}, {.filter = ShadowFilter::triangles});
    }
};

INSTANTIATE_TEST_SUITE_P(Kinds, BarsAlongLight,
                         ::testing::Values(LightKind::directional, LightKind::spot, LightKind::point),
                         [](const auto& test) { return kind_name(test.param); });

TEST_P(BarsAlongLight, AreAsRightAsOthers) {
    constexpr double kMostWrong = 1.0e-5;
    constexpr std::size_t kLeastDark = 1500;
    make_grille(true);
    draw();
    const Judged judged = judge();
    std::cout << judged.metrics.wrong << " of " << judged.metrics.scored << " pixels wrong, " << judged.truly_dark
              << " truly dark\n";
    EXPECT_GT(judged.truly_dark, kLeastDark) << "nothing to lose";
    EXPECT_LE(judged.metrics.fraction(judged.metrics.wrong), kMostWrong);

    // Control: without bars the same truth is missed.
    make_grille(false);
    draw();
    const std::vector<float> lit = visibility(0);
    make_grille(true);
    draw();
    EXPECT_GT(judge(0, frame().snapshot(), lit).metrics.false_light, kLeastDark);
}

}  // namespace
}  // namespace gnomon
