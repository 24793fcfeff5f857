#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/gl/frame_fixture.h"
#include "tests/gl/jitter_phases.h"

/// Samples of a still picture: their mean beside a picture of many more pixels, and the shadows under a moving sample.
namespace gnomon {
namespace {

constexpr std::uint32_t kWidth_px = 96, kHeight_px = 64;

double to_light(std::uint8_t encoded) {
    const double c = encoded / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double to_encoded(double light) {
    return 255.0 * (light <= 0.0031308 ? light * 12.92 : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055);
}

class PictureSamples : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        settings.viewport_px = {kWidth_px, kHeight_px};
        settings.repeatable = true;
        place(add_mesh(game::make_card({0, 0, 0}, {0, 0, 6}, {6, 0, 0})), {}, false);
        const glm::dquat turned = glm::angleAxis(0.4, glm::normalize(glm::dvec3(0.2, 1.0, 0.3)));
        place(add_mesh(game::make_box({-0.5, 0.0, -0.5}, {0.5, 1.5, 0.5})),
              {.translation_m = {0.0, 0.3, 0.0}, .rotation = turned});
        const glm::dquat tilted = glm::angleAxis(0.1, glm::dvec3(0.0, 0.0, 1.0));
        place(add_mesh(game::make_box({-3.0, 0.0, -0.25}, {3.0, 0.4, 0.25})),
              {.translation_m = {0.0, 0.5, 1.5}, .rotation = tilted});
        camera = add_camera({}, {0.0, 5.0, 7.0}, {0.0, -5.0, -7.0});
        sun = add_light({.kind = LightKind::directional, .intensity = 2000.0f}, {}, {1.0, -2.0, 0.5}, {});
        lamp = add_light({.kind = LightKind::spot, .intensity = 5000.0f, .range_m = 12.0f}, {2.0, 4.0, 0.0},
                         {-2.0, -4.0, 0.0}, {});
        point = add_light({.kind = LightKind::point, .intensity = 2000.0f, .range_m = 8.0f}, {-2.0, 3.0, 1.0},
                          {0.0, -1.0, 0.0}, {});
    }
    std::size_t drawn_maps() {
        std::size_t sum = 0;
        for (const LightReport& light : frame().report().lights) sum += light.counts.views_drawn;
        return sum;
    }
    /// Draws until the picture has all samples. Returns false if it never has.
    bool finish() {
        for (int i = 0; i < 300; ++i) {
            draw();
            if (frame().report().samples == settings.still_samples) return true;
        }
        return false;
    }
    /// Averages squares of a finer picture, in light.
    std::vector<double> shrunk(const std::vector<std::uint8_t>& fine, std::uint32_t times) {
        std::vector<double> mean(std::size_t{kWidth_px} * kHeight_px * 3);
        for (std::uint32_t y = 0; y < kHeight_px; ++y)
            for (std::uint32_t x = 0; x < kWidth_px; ++x)
                for (std::uint32_t c = 0; c < 3; ++c) {
                    double sum = 0.0;
                    for (std::uint32_t v = 0; v < times; ++v)
                        for (std::uint32_t u = 0; u < times; ++u)
                            sum += to_light(
                                fine[4 * (std::size_t{y * times + v} * kWidth_px * times + x * times + u) + c]);
                    mean[3 * (std::size_t{y} * kWidth_px + x) + c] = to_encoded(sum / (times * times));
                }
        return mean;
    }
    struct Apart {
        double mean_square = 0.0, largest = 0.0, mean = 0.0;
    };
    static Apart apart(const std::vector<std::uint8_t>& rgba, const std::vector<double>& truth) {
        Apart sum;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double d = rgba[4 * (i / 3) + i % 3] - truth[i];
            sum.mean_square += d * d / static_cast<double>(truth.size());
            sum.mean += d / static_cast<double>(truth.size());
            sum.largest = std::max(sum.largest, std::abs(d));
        }
        return sum;
    }
    ecs::Entity camera, sun, lamp, point;
};

TEST_F(PictureSamples, AreTheMeanOfAFinerPicture) {
    constexpr std::uint32_t kTimes = 16;
    settings.viewport_px = {kWidth_px * kTimes, kHeight_px * kTimes};
    draw();
    const std::vector<double> truth = shrunk(picture(), kTimes);
    settings.viewport_px = {kWidth_px, kHeight_px};
    draw();
    const Apart one = apart(picture(), truth);
    settings.still_samples = 64;
    ASSERT_TRUE(finish());
    const Apart many = apart(picture(), truth);
    std::cout << "one sample: " << one.mean_square << ", 64: " << many.mean_square << " steps squared; at most "
              << one.largest << " and " << many.largest << "\n";
    EXPECT_GT(one.mean_square, 20.0) << "there are edges";
    EXPECT_LT(many.mean_square, one.mean_square / 50.0);
    EXPECT_LT(std::abs(many.mean), 0.3) << "neither brighter nor darker";
}

TEST_F(PictureSamples, OneOfThemIsThePictureAsItWas) {
    for (int i = 0; i < 3; ++i) draw();
    const std::vector<std::uint8_t> plain = picture();
    settings.still_samples = 2;
    ASSERT_TRUE(finish());
    EXPECT_NE(plain, picture());
    settings.still_samples = 1;
    for (int i = 0; i < 3; ++i) draw();
    EXPECT_EQ(plain, picture());
}

/// Compares what lights reach under eight places of the sample.
TEST_F(PictureSamples, MoveNoShadowAndDrawNoMap) {
    constexpr std::uint32_t kPhases = 8;
    settings.still_samples = 1;
    for (int i = 0; i < 100; ++i) draw();
    settings.still_samples = kPhases;
    std::vector<std::vector<std::vector<float>>> seen(3);  // by light and phase
    std::size_t maps = 0;
    for (std::uint32_t phase = 0; phase < kPhases; ++phase) {
        draw();
        EXPECT_EQ(frame().report().samples, phase + 1);
        for (std::uint32_t light = 0; light < 3; ++light) seen[light].push_back(visibility(light));
        maps += drawn_maps();
    }
    EXPECT_EQ(maps, 0u);
    for (const auto& phases : seen) {
        const JitteredPixels pixels = jittered_pixels(phases, kWidth_px);
        EXPECT_GT(pixels.inner, 3000u);
        EXPECT_EQ(pixels.shimmers, 0u);
        EXPECT_GT(pixels.edges, 30u) << "the picture does not jitter";
        EXPECT_LT(pixels.slivers, pixels.edges / 4) << "few things are thinner than a pixel";
    }
}

}  // namespace
}  // namespace gnomon
