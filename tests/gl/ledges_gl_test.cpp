#include <iostream>
#include <random>
#include <vector>

#include "tests/gl/traced_frame_fixture.h"

/// Mouldings: ledges one below the other, each narrower than a texel of the map, so that some show in no texel near
/// what they darken. Walks from ledges that do show go on over undersides
/// (shaders/shadow/filters/triangles/mesh_walk.glsl).
namespace gnomon {
namespace {

/// Kind of light, a map too coarse for the ledges, and the largest share of the picture that may be falsely lit. Walks
/// that end at the first fold leave 0.41, 0.10 and 0.24 % falsely lit, these walks 0.08, 0.04 and 0.13 %. For a point,
/// nearly all of it lies where four texels agree wrongly.
struct Coarse {
    LightKind kind;
    std::uint32_t resolution_px;
    double most_false_light;
};

class Ledges : public TracedFrameTest, public ::testing::WithParamInterface<Coarse> {
protected:
    /// Returns a moulding along z, out of a wall that faces x: teeth with an upper side and an underside each.
    static game::Shape moulding(std::mt19937& random) {
        std::uniform_real_distribution<double> part(0.0, 1.0);
        std::vector<glm::dvec2> profile{{-0.5, -0.5}, {0.0, -0.5}};
        double low_m = 0.0;
        for (int ledge = 0; ledge < 6; ++ledge) {
            const double out_m = 0.02 + 0.06 * part(random), high_m = low_m + 0.01 + 0.03 * part(random);
            profile.emplace_back(0.0, low_m);
            profile.emplace_back(out_m, low_m + 0.01 * part(random));
            low_m = high_m;
        }
        profile.emplace_back(0.0, 0.8);
        profile.emplace_back(-0.5, 0.8);
        return game::make_extrusion(profile, 4.0);
    }
    void make_wall(std::mt19937& random) {
        std::uniform_real_distribution<double> part(0.0, 1.0);
        start_anew();
        place(add_analysed(moulding(random)));
        settings.viewport_px = {320, 200};
        add_camera({.fov_y_rad = 0.5, .near_m = 0.1, .far_m = 20.0}, {1.6, -0.1, 0.7}, {-1.6, 0.2, -0.7});
        const glm::dvec3 at_m(0.1 + 0.8 * part(random), 1.0 + 2.0 * part(random), -1.0 + 2.0 * part(random));
        add_light_of(GetParam().kind, at_m,
                     {.filter = ShadowFilter::triangles, .resolution_px = GetParam().resolution_px, .cascades = 1});
    }
};

INSTANTIATE_TEST_SUITE_P(Kinds, Ledges,
                         ::testing::Values(Coarse{LightKind::directional, 64, 0.0016},
                                           Coarse{LightKind::spot, 256, 0.0006}, Coarse{LightKind::point, 256, 0.0017}),
                         [](const auto& test) { return kind_name(test.param.kind); });

TEST_P(Ledges, DarkenWhatIsBelowThemThroughTexelsWiderThanThey) {
    constexpr int kWalls = 20;
    constexpr double kLeastDark = 0.2, kMostFalseShadow = 0.0001;
    std::mt19937 random(5);
    Tally walls;
    for (int wall = 0; wall < kWalls; ++wall) {
        make_wall(random);
        draw();
        walls.add(judge());
    }
    std::cout << walls.text() << "\n";
    EXPECT_GT(walls.dark, kLeastDark * walls.scored) << "nothing to lose";
    EXPECT_LE(walls.false_light, GetParam().most_false_light * walls.scored);
    EXPECT_LE(walls.false_shadow, kMostFalseShadow * walls.scored);
}

}  // namespace
}  // namespace gnomon
