#include <iostream>
#include <random>

#include "tests/gl/traced_frame_fixture.h"

/// Meshes with a few triangles to a texel. The walk from the triangle that a texel shows still reaches the triangle
/// above the receiver (shaders/shadow/filters/triangles/mesh_walk.glsl, kMostSteps).
namespace gnomon {
namespace {

/// A kind of light, a map of texels several triangles wide, and what of the picture may be wrong through it. Walks of
/// eight steps leave 0.136, 0.079 and 0.058 %, these 0.004, 0.003 and 0.025 %.
struct FewTexels {
    LightKind kind;
    std::uint32_t resolution_px;
    double most_wrong;
};

class FineMeshes : public TracedFrameTest, public ::testing::WithParamInterface<FewTexels> {
protected:
    void make_ball_and_ring(std::mt19937& random) {
        std::uniform_real_distribution<double> part(0.0, 1.0);
        start_anew();
        place(add_analysed(game::make_card({}, {4.0, 0.0, 0.0}, {0.0, 0.0, -4.0})));
        place(add_analysed(game::make_sphere(0.5, 48, 32)), {.translation_m = {part(random) - 0.5, 0.6, 0.0}});
        place(add_analysed(game::make_ring(0.5, 0.1, 48, 16)), {.translation_m = {part(random), 1.2, part(random)}});
        settings.viewport_px = {320, 200};
        add_camera({.fov_y_rad = 0.7}, {1.5, 3.0, 2.5}, {-1.5, -3.0, -2.5});
        add_light_of(GetParam().kind, {part(random), 3.0, part(random)},
                     {.filter = ShadowFilter::triangles, .resolution_px = GetParam().resolution_px, .cascades = 1});
    }
};

INSTANTIATE_TEST_SUITE_P(Kinds, FineMeshes,
                         ::testing::Values(FewTexels{LightKind::directional, 64, 0.0002},
                                           FewTexels{LightKind::spot, 64, 0.0002},
                                           FewTexels{LightKind::point, 64, 0.0004}),
                         [](const auto& test) { return kind_name(test.param.kind); });

TEST_P(FineMeshes, CastTheirOwnEdgesThroughTexelsSeveralTrianglesWide) {
    constexpr int kRounds = 10;
    constexpr double kLeastDark = 0.05;
    std::mt19937 random(5);
    Tally rounds;
    for (int round = 0; round < kRounds; ++round) {
        make_ball_and_ring(random);
        draw();
        rounds.add(judge());
    }
    std::cout << rounds.text() << "\n";
    EXPECT_GT(rounds.dark, kLeastDark * rounds.scored) << "nothing to lose";
    EXPECT_LE(rounds.false_light + rounds.false_shadow, GetParam().most_wrong * rounds.scored);
}

}  // namespace
}  // namespace gnomon
