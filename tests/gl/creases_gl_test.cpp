#include <random>
#include <vector>

#include "tests/gl/traced_frame_fixture.h"
#include "tests/unit/math/random_seed.h"

/// Surfaces that meet: beside a crease a receiver that is off its own plane by rounding lies behind its neighbour's.
namespace gnomon {
namespace {

/// A kind of light, and a map whose texels are no wider than folds.
struct Fine {
    LightKind kind;
    std::uint32_t resolution_px;
};

class Creases : public TracedFrameTest, public ::testing::WithParamInterface<Fine> {
protected:
    using Random = std::mt19937_64;
    static double between(double least, double most, Random& random) {
        return std::uniform_real_distribution<double>(least, most)(random);
    }
    /// A sheet in folds along z, whose steepest side rises by 3 in 2.
    static game::Shape folded_sheet(Random& random) {
        std::vector<glm::dvec2> profile{{1.0, -0.5}};
        for (double x_m = 1.0; x_m > -1.0;) {
            const double down_m = between(0.006, 0.02, random), up_m = between(0.006, 0.02, random);
            profile.emplace_back(x_m, 0.0);
            profile.emplace_back(x_m - down_m, -between(0.2, 1.5, random) * std::min(down_m, up_m));
            x_m -= down_m + up_m;
        }
        profile.emplace_back(-1.1, 0.0);
        profile.emplace_back(-1.1, -0.5);
        return game::make_extrusion(profile, 2.0);
    }
    /// Lit from so far above that no fold darkens another, and seen from aside, so near that all of the picture shows
    /// it.
    void make_sheet(CameraProjection projection, Random& random) {
        start_anew();
        place(add_analysed(folded_sheet(random)));
        settings.viewport_px = {960, 600};
        const double azimuth = between(0.0, 6.283, random), elevation = between(0.6, 1.2, random);
        const glm::dvec3 eye_m = 1.5 * glm::dvec3(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                                                  std::cos(elevation) * std::sin(azimuth));
        // An orthographic view's depths are spread over its range, which ends where nobody said.
        add_camera({.projection = projection, .fov_y_rad = 0.3, .half_height_m = 0.2, .near_m = 0.1}, eye_m, -eye_m);
        add_light_of(GetParam().kind, {between(-0.8, 0.8, random), 8.0, between(-8.0, 8.0, random)},
                     {.filter = ShadowFilter::triangles, .resolution_px = GetParam().resolution_px, .cascades = 1});
    }
};

INSTANTIATE_TEST_SUITE_P(Kinds, Creases,
                         ::testing::Values(Fine{LightKind::directional, 256}, Fine{LightKind::spot, 256},
                                           Fine{LightKind::point, 2048}),
                         [](const auto& test) { return kind_name(test.param.kind); });

// Sides rise by 3 in 2 at most, and the light stands higher than 4 in 1 above every one of them.
TEST_P(Creases, AreLitWhereNothingDarkensThem) {
    constexpr int kSheets = 15;
    Random random(print_seed());
    for (const CameraProjection projection : {CameraProjection::perspective, CameraProjection::orthographic}) {
        std::size_t dark = 0;
        for (int sheet = 0; sheet < kSheets; ++sheet) {
            make_sheet(projection, random);
            draw();
            for (const float visible : visibility(0)) dark += visible < 1.0f;
        }
        EXPECT_EQ(dark, 0u) << "projection " << static_cast<int>(projection);
    }
}

}  // namespace
}  // namespace gnomon
