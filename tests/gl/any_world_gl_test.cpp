#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <sstream>
#include <vector>

#include "tests/gl/traced_frame_fixture.h"
#include "tests/unit/math/random_seed.h"

/// Worlds that a user may put together, with no setting tuned: random things of random sizes around random places.
/// Cameras have either projection with any near and far; lights are of each kind with any range and cone.
namespace gnomon {
namespace {

class AnyWorld : public TracedFrameTest {
protected:
    using Random = std::mt19937_64;
    static double between(double least, double most, Random& random) {
        return std::uniform_real_distribution<double>(least, most)(random);
    }
    /// Draws a size; each order of magnitude is as likely as another.
    static double of_any_size(double least, double most, Random& random) {
        return least * std::pow(most / least, between(0.0, 1.0, random));
    }
    static bool chance(double share, Random& random) { return between(0.0, 1.0, random) < share; }
    static glm::dvec3 anywhere(Random& random) {
        return {between(-1.0, 1.0, random), between(-1.0, 1.0, random), between(-1.0, 1.0, random)};
    }
    /// Draws a vector to a place above the ground or just over it, at a distance of any size.
    static glm::dvec3 from_above(double least_distance, double most_distance, Random& random) {
        const double azimuth = between(0.0, 6.283, random), elevation = between(0.05, 1.57, random);
        return of_any_size(least_distance, most_distance, random) * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                                                               std::sin(elevation),
                                                                               std::cos(elevation) * std::sin(azimuth));
    }

    /// Returns the ground's size, m.
    double add_things(double unit_m, const glm::dvec3& origin_m, Random& random) {
        const std::vector<std::uint32_t> meshes = {
            add_analysed(game::make_box(glm::dvec3(-0.5), glm::dvec3(0.5))),
            add_analysed(game::make_sphere(0.5, 24, 16)),
            add_analysed(game::make_card({}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0})),
            add_analysed(game::make_ring(0.5, 0.08, 24, 8)),
            add_analysed(game::make_bar({0.0, -0.5, 0.0}, {0.0, 0.5, 0.0}, 0.03, 8)),
            add_analysed(game::make_cloth(1.0, 1.0, 0.1, 3.0, 24, 12))};
        const std::uint32_t ground = add_analysed(game::make_card({}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}));
        const double ground_m = unit_m * of_any_size(5.0, 5000.0, random);
        place(ground, {.translation_m = origin_m, .scale = glm::dvec3(ground_m)});
        const int count = static_cast<int>(of_any_size(1.0, 40.0, random));
        for (int i = 0; i < count; ++i) {
            const double size_m = unit_m * of_any_size(0.1, 3.0, random);
            const glm::dvec3 sizes = glm::dvec3(between(0.3, 2.0, random), 1.0, chance(0.2, random) ? -1.0 : 1.0);
            place(meshes[static_cast<std::size_t>(i) % meshes.size()],
                  {.translation_m =
                       origin_m + unit_m * (glm::dvec3(0.0, 1.4, 0.0) + glm::dvec3(5.0, 1.6, 5.0) * anywhere(random)),
                   .rotation = looking_along(anywhere(random)),
                   .scale = size_m * sizes},
                  chance(0.9, random));
        }
        return ground_m;
    }
    Camera any_camera(double unit_m, double ground_m, Random& random) {
        Camera camera{.near_m = unit_m * of_any_size(1.0e-3, 0.2, random)};
        if (chance(0.3, random)) {
            camera.projection = CameraProjection::orthographic;
            constexpr double kLargestGround = 1500.0;  // times the picture's height (docs/reference/limits.md)
            camera.half_height_m = std::max(unit_m * of_any_size(0.5, 8.0, random), 0.5 * ground_m / kLargestGround);
        } else {
            camera.fov_y_rad = between(0.2, 2.0, random);
            if (chance(0.2, random)) camera.far_m = std::numeric_limits<double>::infinity();
        }
        return camera;
    }
    void make_world(Random& random) {
        start_anew();
        const double unit_m = chance(0.5, random) ? 1.0 : of_any_size(1.0e-3, 1.0e4, random);
        const glm::dvec3 origin_m =
            chance(0.5, random) ? glm::dvec3(0.0) : of_any_size(1.0, 1.0e7, random) * anywhere(random);
        const double ground_m = add_things(unit_m, origin_m, random);
        settings.viewport_px = {320, 200};
        const Camera camera = any_camera(unit_m, ground_m, random);
        const glm::dvec3 eye_m = unit_m * from_above(2.0, 15.0, random);
        add_camera(camera, origin_m + eye_m, unit_m * anywhere(random) - eye_m);
        std::ostringstream text;
        text << "unit " << unit_m << " m, " << glm::length(origin_m) << " m away, "
             << (camera.projection == CameraProjection::orthographic ? "orthographic" : "perspective") << ", near "
             << camera.near_m << " m";
        what_ = text.str();
        for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
            Light light{.kind = kind, .outer_cone_rad = static_cast<float>(between(0.1, 1.57, random))};
            if (chance(0.5, random)) light.range_m = static_cast<float>(unit_m * of_any_size(1.0, 50.0, random));
            const glm::dvec3 at_m = unit_m * from_above(0.5, 20.0, random);
            add_light(light, origin_m + at_m, unit_m * 2.0 * anywhere(random) - at_m, {});
        }
    }
    std::string what_;
};

// So small a picture has maps of 512 texels, which leave one pixel in thirty thousand wrong. Where a lamp's texel is
// tens of pixels wide, one in a hundred is wrong. A light may state that it loses wider things, and lose them.
TEST_F(AnyWorld, IsShadowedRightWithNothingTuned) {
    constexpr int kWorlds = 40;
    constexpr double kMostWrong = 2.5e-4, kMostWrongOfOne = 0.03, kLeastDark = 0.02;
    constexpr std::size_t kManyPixels = 2000;
    constexpr double kWideThing_px = 64.0;
    Random random(print_seed());
    Tally worlds;
    int lights = 0, coarse = 0;
    for (int number = 0; number < kWorlds; ++number) {
        make_world(random);
        draw();
        for (std::uint32_t i = 0; i < 3; ++i) {
            const Judged judged = judge(i, frame().snapshot());
            worlds.add(judged);
            const std::size_t wrong = judged.metrics.false_shadow + judged.metrics.false_light;
            if (judged.metrics.scored < kManyPixels) continue;
            ++lights;
            if (frame().report().lights[i].resolved.px > kWideThing_px) {
                ++coarse;
                continue;
            }
            EXPECT_LE(static_cast<double>(wrong), kMostWrongOfOne * static_cast<double>(judged.metrics.scored))
                << "world " << number << ", light " << i << ": " << what_;
        }
    }
    std::cout << worlds.text() << "\n";
    EXPECT_LE(coarse, lights / 10) << "too few are judged one by one";
    EXPECT_GT(worlds.dark, kLeastDark * worlds.scored) << "nothing to lose";
    EXPECT_LE(worlds.false_light + worlds.false_shadow, kMostWrong * worlds.scored);
}

}  // namespace
}  // namespace gnomon
