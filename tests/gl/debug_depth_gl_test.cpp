#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "systems/debug/debug_view.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/frame_fixture.h"

// The debug view "depth" against distances that are known: pixels of grey against metres.
namespace gnomon {
namespace {

constexpr std::uint32_t kWidth = 320, kHeight = 256;
constexpr std::int32_t kTitle_px = 20;

struct Colour {
    int red, green, blue;
    bool grey() const { return red == green && green == blue; }
};

class DebugDepth : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        add_camera({.fov_y_rad = 1.2}, {0.0, 3.0, 9.0}, {0.0, -0.3, -1.0});
    }
    /// Adds a wall around `at`, `half_m` to each side along x and y, that casts and receives.
    void add_wall(const glm::dvec3& at, double half_m) {
        place(add_mesh(
            game::make_box(at - half_m * glm::dvec3(1.0, 1.0, 0.01), at + half_m * glm::dvec3(1.0, 1.0, 0.01))));
    }
    void show(const std::string& light, std::optional<std::uint32_t> layer = {}) {
        settings.debug = {.view = debug::find_view("depth"), .light = light, .layer = layer};
        draw();
        rgba_ = picture();
    }
    /// Returns a pixel's colour; x and y count from the lower left, as in GL.
    Colour at(std::int32_t x, std::int32_t y) const {
        const std::size_t i = 4 * ((kHeight - 1 - static_cast<std::size_t>(y)) * kWidth + static_cast<std::size_t>(x));
        return {rgba_[i], rgba_[i + 1], rgba_[i + 2]};
    }
    /// Returns the range that label `index` of the view names, metres: near and far.
    std::pair<double, double> range(std::size_t index) {
        double near_m = -1.0, far_m = -1.0;
        const std::string& text = frame().debug_labels().at(index).text;
        EXPECT_EQ(std::sscanf(text.c_str() + text.find(':'), ": %lf ... %lf m", &near_m, &far_m), 2) << text;
        return {near_m, far_m};
    }
    static bool blue(const Colour& c) { return c.blue > 2 * c.green && c.green > c.red; }

    std::vector<std::uint8_t> rgba_;
};

TEST_F(DebugDepth, ASpotsWallIsAsGreyAsItIsFarAndBesideItIsNothing) {
    add_wall({0.0, 0.0, -8.0}, 6.0);
    add_wall({0.0, 0.0, -3.0}, 0.5);
    add_light({.kind = LightKind::spot, .intensity = 1000.0f, .inner_cone_rad = 0.4f, .outer_cone_rad = 0.7f},
              {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    draw();
    const std::string name = frame().snapshot().lights.front().name;
    show(name);
    const auto named = range(1);
    const double near_m = named.first, far_m = named.second;  // clang 14 captures no structured bindings
    ASSERT_LT(near_m, 3.0);
    ASSERT_GT(far_m, 7.9);
    const std::int32_t edge = kHeight - kTitle_px, left = (kWidth - edge) / 2;
    const auto byte = [&](double distance_m) { return 255.0 * (distance_m - near_m) / (far_m - near_m); };
    const Colour middle = at(left + edge / 2, edge / 2), aside = at(left + 5 * edge / 6, edge / 2);
    EXPECT_TRUE(middle.grey() && aside.grey());
    // The range is named with three digits: half a percent of 255 twice, and half a step of the byte.
    EXPECT_NEAR(middle.red, byte(2.995), 3.0);
    EXPECT_NEAR(aside.red, byte(7.94), 3.0);
    EXPECT_GT(aside.red, middle.red + 60);
    EXPECT_TRUE(at(left - 5, edge / 2).red < 30) << "the background is dark";
}

TEST_F(DebugDepth, WhatNoCasterCoversIsBlue) {
    add_wall({0.0, 0.0, -3.0}, 0.5);
    place(add_mesh(game::make_box({-6.0, -6.0, -8.0}, {6.0, 6.0, -7.9})), {}, false);
    add_light({.kind = LightKind::spot, .intensity = 1000.0f, .inner_cone_rad = 0.4f, .outer_cone_rad = 0.7f},
              {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    draw();
    show(frame().snapshot().lights.front().name);
    const std::int32_t edge = kHeight - kTitle_px, left = (kWidth - edge) / 2;
    EXPECT_TRUE(at(left + edge / 2, edge / 2).grey());
    EXPECT_TRUE(blue(at(left + 5 * edge / 6, edge / 2)));
    EXPECT_TRUE(blue(at(left + 2, 2)));
}

TEST_F(DebugDepth, EachFaceOfACubeLiesWhereItsCasterIs) {
    add_wall({0.0, 0.0, -8.0}, 8.0);
    // One caster before each face and along its axes, each at its own distance, upright where the cross has it.
    const auto box = add_mesh(game::make_box(glm::dvec3(-0.3), glm::dvec3(0.3)));
    for (std::uint32_t face = 0; face < 6; ++face) {
        const glm::dvec3 ahead = shadow::cube_turn() * -shadow::cube_face(face).axis_back;
        place(box, {.translation_m = (1.5 + 0.5 * face) * ahead, .rotation = shadow::cube_turn()});
    }
    add_light({.kind = LightKind::point, .intensity = 1000.0f}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    draw();
    show(frame().snapshot().lights.front().name);
    const auto [near_m, far_m] = range(1);
    const std::int32_t edge = std::min<std::int32_t>(kWidth / 4, (kHeight - kTitle_px) / 3);
    const std::int32_t left = (kWidth - 4 * edge) / 2, bottom = (kHeight - kTitle_px - 3 * edge) / 2;
    const glm::ivec2 cells[] = {{2, 1}, {0, 1}, {1, 2}, {1, 0}, {3, 1}, {1, 1}};
    for (int face = 0; face < 6; ++face) {
        const Colour c = at(left + cells[face].x * edge + edge / 2, bottom + cells[face].y * edge + edge / 2);
        EXPECT_TRUE(c.grey()) << face;
        EXPECT_NEAR(c.red, 255.0 * (1.2 + 0.5 * face - near_m) / (far_m - near_m), 4.0) << face;
    }
    EXPECT_LT(at(left + 2, bottom + 2).red, 30) << "no face lies in the cross's corner";
}

TEST_F(DebugDepth, ASunsCascadesAreLinearAsTheyAreAndOneCanBeShownAlone) {
    place(add_mesh(game::make_box({-20.0, -1.0, -20.0}, {20.0, 0.0, 20.0})));
    place(add_mesh(game::make_box({-1.0, 2.0, -1.0}, {1.0, 3.0, 1.0})));
    add_light({.kind = LightKind::directional, .intensity = 1000.0f}, {0.0, 10.0, 0.0}, {0.0, -1.0, 0.0});
    draw();
    const std::string name = frame().snapshot().lights.front().name;
    show(name);
    const std::size_t maps = frame().debug_labels().size() - 1;
    EXPECT_GE(maps, 2u);
    // In the map that holds the box, its top is 3 m above the ground at the map's far end.
    double tallest_m = 0.0;
    for (std::uint32_t map = 0; map < maps; ++map) {
        show(name, map);
        ASSERT_EQ(frame().debug_labels().size(), 2u);
        const auto [near_m, far_m] = range(1);
        EXPECT_EQ(near_m, 0.0);
        int darkest = 255, brightest = 0;
        const std::int32_t edge = kHeight - kTitle_px, left = (kWidth - edge) / 2;
        for (std::int32_t y = 0; y < 4 * edge / 5; ++y)  // the label lies above
            for (std::int32_t x = left; x < left + edge; ++x) {
                const Colour c = at(x, y);
                if (!c.grey()) continue;
                darkest = std::min(darkest, c.red);
                brightest = std::max(brightest, c.red);
            }
        tallest_m = std::max(tallest_m, (brightest - darkest) / 255.0 * far_m);
    }
    EXPECT_NEAR(tallest_m, 3.0, 0.1);
}

TEST_F(DebugDepth, AReusedMapShowsTheSamePicture) {
    add_wall({0.0, 0.0, -8.0}, 6.0);
    add_light({.kind = LightKind::spot, .intensity = 1000.0f, .inner_cone_rad = 0.4f, .outer_cone_rad = 0.7f},
              {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    draw();
    show(frame().snapshot().lights.front().name);
    const auto first = rgba_;
    show(frame().snapshot().lights.front().name);
    EXPECT_EQ(frame().report().lights.front().state, LightState::reused);
    EXPECT_EQ(rgba_, first);
    settings.debug = {};
    draw();
    EXPECT_NE(picture(), first);
}

}  // namespace
}  // namespace gnomon
