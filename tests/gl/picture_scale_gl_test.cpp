#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/gl/frame_fixture.h"

// Neither the scale of a scene nor the strength of its lights changes its picture, if the exposure follows.
namespace gnomon {
namespace {

using Picture = std::vector<std::uint8_t>;
constexpr glm::uvec2 kYard_px{96, 64};

class PictureScale : public FrameTest {
protected:
    struct Yard {
        double scale = 1.0;
        double lamp_m = 6.0;            // from the middle
        double candela_per_m2 = 100.0;  // over the lamp's squared distance
        double own_candela = 0.0;       // instead, if above 0
    };

    /// Makes a ground, a box and a lamp, all `scale` times as large.
    void make(const Yard& yard) {
        start_anew();
        settings.viewport_px = kYard_px;
        const double s = yard.scale;
        const float shine = static_cast<float>(
            yard.own_candela > 0.0 ? yard.own_candela : yard.candela_per_m2 * yard.lamp_m * yard.lamp_m * s * s);
        add_material({.name = "matt", .base_colour = glm::vec4(glm::vec3(0.8f), 1.0f), .metallic = 0.0f});
        place(add_mesh(game::make_card(glm::dvec3(0.0), {14.0 * s, 0.0, 0.0}, {0.0, 0.0, -14.0 * s})));
        place(add_mesh(game::make_box({-0.5 * s, 0.0, -0.5 * s}, {0.5 * s, s, 0.5 * s})));
        add_light({.kind = LightKind::point, .intensity = shine},
                  glm::normalize(glm::dvec3(-3.0, 4.5, 1.8)) * (yard.lamp_m * s), {0.0, -1.0, 0.0});
        add_camera({.fov_y_rad = 0.785, .near_m = 0.05 * s, .far_m = 200.0 * s}, glm::dvec3(3.6, 3.2, 5.2) * s,
                   {-3.6, -2.7, -5.2});
    }

    Picture drawn(const Yard& yard) {
        make(yard);
        draw();
        seen_ = visibility();
        return picture();
    }

    /// Means of the bytes where the lamp is seen and not seen.
    struct Means {
        double lit = 0.0, dark = 0.0;
    };
    Means means(const Picture& rgba) const {
        double sum[2] = {}, count[2] = {};
        for (std::uint32_t y = 0; y < kYard_px.y; ++y)
            for (std::uint32_t x = 0; x < kYard_px.x; ++x) {
                const float v = seen_[std::size_t{kYard_px.y - 1 - y} * kYard_px.x + x];
                if (v != 0.0f && v != 1.0f) continue;
                sum[v == 1.0f] += rgba[(std::size_t{y} * kYard_px.x + x) * 4];
                count[v == 1.0f] += 1.0;
            }
        return {sum[1] / count[1], sum[0] / count[0]};
    }

    std::vector<float> seen_;
};

int most_apart(const Picture& a, const Picture& b) {
    int most = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        most = std::max(most, std::abs(int{a[i]} - int{b[i]}));
    return a.size() == b.size() ? most : 256;
}

TEST_F(PictureScale, ALargerYardWithAsMuchBrighterLampLooksTheSame) {
    for (const bool automatic : {true, false}) {
        settings.exposure_ev = 4.0f;
        if (automatic) settings.exposure_ev.reset();
        const Picture unit = drawn({});
        const Means means_of_unit = means(unit);
        EXPECT_GT(means_of_unit.lit, 1.3 * means_of_unit.dark) << "there is no shadow to tell apart";
        for (const double scale : {0x1p-13, 100.0, 0x1p20})
            EXPECT_LE(most_apart(drawn({.scale = scale}), unit), 1) << scale << (automatic ? " automatic" : "");
    }
}

TEST_F(PictureScale, AFartherLampThatGivesTheYardAsMuchLeavesItsShadowAsDark) {
    settings.exposure_ev = 4.0f;
    const Means near = means(drawn({.lamp_m = 6.0}));
    for (const double lamp_m : {20.0, 100.0}) {
        const Means far = means(drawn({.lamp_m = lamp_m}));
        EXPECT_NEAR(far.dark, near.dark, 6.0) << lamp_m;
        EXPECT_NEAR(far.lit, near.lit, 12.0) << lamp_m;
        EXPECT_GT(far.lit, 1.3 * far.dark) << lamp_m;
    }
}

TEST_F(PictureScale, AutomaticExposureFollowsFromAMillionthOfACandelaToWhateverALightMayHave) {
    settings.exposure_ev.reset();
    const Picture usual = drawn({.lamp_m = 2.0, .own_candela = 100.0});
    EXPECT_GT(means(usual).lit, 60.0);
    for (const double candela : {1e-20, 1e-6, 1e-2, 1e5, 1e7, 1e9, 1e12, 1e30})
        EXPECT_LE(most_apart(drawn({.lamp_m = 2.0, .own_candela = candela}), usual), 1) << candela;
}

TEST_F(PictureScale, AnExposureThatIsGivenAsMuchHigherAsTheLampIsBrighterShowsTheSame) {
    settings.exposure_ev = 4.0f;
    const Picture usual = drawn({});
    for (const int stops : {-50, -20, 10, 20, 50}) {
        settings.exposure_ev = 4.0f + static_cast<float>(stops);
        EXPECT_LE(most_apart(drawn({.candela_per_m2 = 100.0 * std::exp2(stops)}), usual), 1) << stops;
    }
}

TEST_F(PictureScale, WhatIsFarBrighterThanAnExposureIsWhiteAndNotGrey) {
    for (const float ev : {4.0f, 14.0f, 30.0f}) {
        settings.exposure_ev = ev;
        const Picture bright = drawn({.candela_per_m2 = 1e5 * std::exp2(static_cast<double>(ev))});
        EXPECT_EQ(means(bright).lit, 255.0) << ev;
    }
}

TEST_F(PictureScale, WhatAloneShinesInTheDarkIsExposedHoweverBright) {
    settings.viewport_px = kYard_px;
    settings.exposure_ev.reset();
    Picture usual;
    for (const float emitted : {1.0f, 1e-6f, 1e7f, 1e20f}) {
        start_anew();
        add_material({.name = "glow", .emissive = glm::vec3(emitted)});
        place(add_mesh(game::make_card(glm::dvec3(0.0), {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0})));
        add_camera({}, {0.0, 0.0, 3.0}, {0.0, 0.0, -1.0});
        draw();
        if (usual.empty()) usual = picture();
        const std::size_t middle = 4 * (std::size_t{kYard_px.x} * (kYard_px.y / 2) + kYard_px.x / 2);
        EXPECT_GT(int{usual[middle]}, 60);
        EXPECT_LE(most_apart(picture(), usual), 1) << emitted;
    }
}

TEST_F(PictureScale, OfTheBrightestLampThatFloatsHoldNoPixelIsBlack) {
    settings.exposure_ev.reset();
    make({.lamp_m = 2.0, .own_candela = 3e37});
    world.patch<Light>(world.entities_with<Light>().front(), [](Light& light) { light.colour = glm::vec3(3.0f); });
    draw();
    EXPECT_TRUE(frame().report().dropped.empty());
    const Picture rgba = picture();
    for (std::size_t i = 0; i < rgba.size(); i += 4) ASSERT_GT(int{rgba[i]}, 0) << i / 4;
}

}  // namespace
}  // namespace gnomon
