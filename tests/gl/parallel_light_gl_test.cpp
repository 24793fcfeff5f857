#include <random>

#include "tests/gl/frame_fixture.h"
#include "tests/unit/math/random_seed.h"

// No surface that a light reaches is black, or no number, where light and view are parallel or nearly so. Visibility is
// right there whatever comes of the light.
namespace gnomon {
namespace {

constexpr glm::uvec2 kWall_px{96, 64};
constexpr int kDarkestWall =
    8;  // least level of a wall's pixel, of 255: no wall here is so aslant (71 degrees) or far (12 m)

enum class Setup { torch_at_eye, bulb_at_eye, sun_behind_orthographic, bulb_in_view, torch_nearly_at_eye };

struct Row {
    const char* name;
    Setup setup;
    friend void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }
};

class ParallelLightOf : public FrameTest, public ::testing::WithParamInterface<Row> {
protected:
    /// Adds a matt wall that fills the picture, seen along a random direction, and a light for it.
    void make_world(std::mt19937& random) {
        std::uniform_real_distribution<double> number(-1.0, 1.0);
        start_anew();
        const glm::dvec3 along = glm::normalize(glm::dvec3(number(random), number(random), number(random)));
        const glm::dvec3 tilt =
            glm::normalize(-along + 0.35 * glm::dvec3(number(random), number(random), number(random)));
        const glm::dvec3 eye(8.0 * number(random), 8.0 * number(random), 8.0 * number(random));
        const double away_m = 3.0 + 2.0 * number(random);
        add_material({.name = "matt", .base_colour = glm::vec4(glm::vec3(0.5f), 1.0f), .metallic = 0.0f});
        const glm::dquat facing = looking_along(-tilt);
        place(add_mesh(game::make_card(glm::dvec3(0.0), {80.0, 0.0, 0.0}, {0.0, 80.0, 0.0})),
              {.translation_m = eye + away_m * along, .rotation = facing});
        const bool orthographic = GetParam().setup == Setup::sun_behind_orthographic;
        Camera camera{.fov_y_rad = 0.7};
        if (orthographic)
            camera = {.projection = CameraProjection::orthographic, .half_height_m = 1.0, .near_m = 0.1, .far_m = 40.0};
        add_camera(camera, eye, along);
        add_light(light(), place_of_light(eye, along, away_m, number(random)), along);
    }

    Light light() const {
        switch (GetParam().setup) {
            case Setup::torch_at_eye:
            case Setup::torch_nearly_at_eye:
                return {.kind = LightKind::spot, .intensity = 100.0f, .outer_cone_rad = 1.2f};
            case Setup::sun_behind_orthographic:
                return {.kind = LightKind::directional, .intensity = 5.0f};
            default:
                return {.kind = LightKind::point, .intensity = 100.0f};
        }
    }

    glm::dvec3 place_of_light(const glm::dvec3& eye, const glm::dvec3& along, double away_m, double share) const {
        if (GetParam().setup == Setup::bulb_in_view) return eye + (0.4 + 0.1 * share) * away_m * along;
        if (GetParam().setup == Setup::torch_nearly_at_eye) return eye + 1e-4 * share * glm::dvec3(1.0, 1.0, 1.0);
        return eye;
    }
};

TEST_P(ParallelLightOf, NoLitPixelIsBlackOrNoNumber) {
    std::mt19937 random(print_seed());
    settings = {.viewport_px = kWall_px, .exposure_ev = 3.0f, .leave_out_dim_lights = false};
    for (int trial = 0; trial < 12; ++trial) {
        make_world(random);
        draw();
        const std::vector<float> seen = visibility();
        const std::vector<std::uint8_t> rgba = picture();
        std::size_t lit = 0, black = 0, white = 0;
        for (std::uint32_t y = 0; y < kWall_px.y; ++y)
            for (std::uint32_t x = 0; x < kWall_px.x; ++x) {
                if (seen[std::size_t{kWall_px.y - 1 - y} * kWall_px.x + x] != 1.0f) continue;
                const std::size_t at = (std::size_t{y} * kWall_px.x + x) * 4;
                ++lit;
                black += rgba[at] < kDarkestWall;
                white += rgba[at] == 255;
            }
        EXPECT_GT(lit, std::size_t{kWall_px.x} * kWall_px.y / 2) << trial;
        EXPECT_EQ(black, 0u) << trial;
        EXPECT_EQ(white, 0u) << trial;
    }
}

INSTANTIATE_TEST_SUITE_P(EachSetup, ParallelLightOf,
                         ::testing::Values(Row{"TorchAtEye", Setup::torch_at_eye}, Row{"BulbAtEye", Setup::bulb_at_eye},
                                           Row{"SunBehindOrthographic", Setup::sun_behind_orthographic},
                                           Row{"BulbInView", Setup::bulb_in_view},
                                           Row{"TorchNearlyAtEye", Setup::torch_nearly_at_eye}),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace gnomon
