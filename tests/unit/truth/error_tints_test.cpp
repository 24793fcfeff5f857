#include "systems/truth/error_tints.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace gnomon::truth {
namespace {

constexpr glm::uvec2 kSize_px{9, 7};
constexpr std::size_t kPixels = 63, kMiddle = 3 * 9 + 4;

LightTruth all_lit() {
    LightTruth truth;
    truth.reset(kPixels);
    truth.visibility.assign(kPixels, 1.0f);
    truth.scored.assign(kPixels, 1);
    return truth;
}

std::array<int, 4> tint_at(const std::vector<std::uint8_t>& rgba, std::size_t pixel) {
    const std::size_t at = 4 * pixel;
    return {rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]};
}

std::vector<std::uint8_t> tinted(std::span<const DrawnLight> lights) {
    std::vector<std::uint8_t> rgba;
    tint_errors(kSize_px, lights, rgba);
    EXPECT_EQ(rgba.size(), 4 * kPixels);
    return rgba;
}

TEST(ErrorTints, WhatIsRightIsDarkenedAndHasNoColour) {
    const LightTruth truth = all_lit();
    const std::vector<float> measured(kPixels, 1.0f);
    const auto rgba = tinted(std::array{DrawnLight{measured, &truth}});
    const auto first = tint_at(rgba, 0);
    EXPECT_EQ(first[0] + first[1] + first[2], 0);
    EXPECT_GT(first[3], 0);
    EXPECT_LT(first[3], 255);
    for (std::size_t i = 0; i < kPixels; ++i) EXPECT_EQ(tint_at(rgba, i), first) << i;
}

TEST(ErrorTints, OfASourceWithASizeAreWrongByMoreThanAHalfNotByTheSideOfIt) {
    LightTruth truth = all_lit();
    truth.visibility[kMiddle] = 0.45f;
    std::vector<float> measured(kPixels, 1.0f);
    measured[kMiddle] = 0.55f;
    const auto near = tint_at(tinted(std::array{DrawnLight{measured, &truth}}), kMiddle);
    EXPECT_LT(near[3], 255);
    EXPECT_GT(near[2], near[0]) << "a little too bright";
    measured[kMiddle] = 0.97f;
    const auto far = tint_at(tinted(std::array{DrawnLight{measured, &truth}}), kMiddle);
    EXPECT_EQ(far[3], 255);
    EXPECT_GT(far[2], far[0]);
}

TEST(ErrorTints, OfAChannelBehindGlassCountLikeThoseOfVisibility) {
    const LightTruth truth = all_lit();
    const std::vector<float> measured(kPixels, 1.0f);
    std::vector<float> tint_off(kPixels, 0.0f);
    const std::array light{DrawnLight{measured, &truth, tint_off}};
    EXPECT_EQ(tinted(light), tinted(std::array{DrawnLight{measured, &truth}}));
    tint_off[kMiddle] = -0.2f;
    const auto dark = tint_at(tinted(light), kMiddle);
    EXPECT_GT(dark[0], dark[2]) << "too dark";
    EXPECT_LT(dark[3], 255);
    tint_off[kMiddle] = 0.7f;
    const auto bright = tint_at(tinted(light), kMiddle);
    EXPECT_GT(bright[2], bright[0]) << "too bright";
    EXPECT_EQ(bright[3], 255) << "by more than a half";
}

TEST(ErrorTints, AWrongPixelIsOpaqueInTheColourOfItsDirectionAndHasAHalo) {
    LightTruth truth = all_lit();
    std::vector<float> measured(kPixels, 1.0f);
    measured[kMiddle] = 0.2f;
    const auto missing = tinted(std::array{DrawnLight{measured, &truth}});
    truth.visibility.assign(kPixels, 0.0f);
    measured.assign(kPixels, 0.0f);
    measured[kMiddle] = 0.8f;
    const auto surplus = tinted(std::array{DrawnLight{measured, &truth}});
    const auto red = tint_at(missing, kMiddle), blue = tint_at(surplus, kMiddle);
    EXPECT_EQ(red[3], 255);
    EXPECT_GT(red[0], red[2]);
    EXPECT_EQ(blue[3], 255);
    EXPECT_GT(blue[2], blue[0]);
    const auto halo = tint_at(missing, kMiddle + kHalo_px);
    EXPECT_EQ(halo[0], red[0]);
    EXPECT_LT(halo[3], 255);
    EXPECT_EQ(tint_at(missing, kMiddle + kHalo_px + 1)[0], 0);
    EXPECT_EQ(tint_at(missing, kMiddle - 9 * kHalo_px)[0], red[0]);
}

TEST(ErrorTints, AnErrorBelowAHalfIsFaintByItsSize) {
    const LightTruth truth = all_lit();
    std::vector<float> measured(kPixels, 1.0f);
    measured[0] = 0.9f;
    measured[4] = 0.6f;
    measured[8] = 0.4f;
    const auto rgba = tinted(std::array{DrawnLight{measured, &truth}});
    const auto a = tint_at(rgba, 0), b = tint_at(rgba, 4), wrong = tint_at(rgba, 8);
    EXPECT_GT(a[0], 0);
    EXPECT_GT(b[0], a[0]);
    EXPECT_GT(wrong[0], b[0]);
    EXPECT_LT(b[3], 255);
    EXPECT_EQ(tint_at(rgba, 9 * 3)[0], 0) << "nothing near it: no halo";
}

TEST(ErrorTints, TheLightThatIsFarthestOffShowsAtEachPixel) {
    const LightTruth truth = all_lit();
    LightTruth dark = all_lit();
    dark.visibility.assign(kPixels, 0.0f);
    std::vector<float> near(kPixels, 0.8f), off(kPixels, 0.0f);
    off[kMiddle] = 0.9f;
    const auto rgba = tinted(std::array{DrawnLight{near, &truth}, DrawnLight{off, &dark}});
    const auto middle = tint_at(rgba, kMiddle), corner = tint_at(rgba, 0);
    EXPECT_GT(middle[2], middle[0]) << "the second light's false light";
    EXPECT_GT(corner[0], corner[2]) << "the first light's missing light";
}

TEST(ErrorTints, WhatIsNotScoredOrAmbiguousIsNotWrongAndWhatIsNotCoveredIs) {
    LightTruth truth = all_lit();
    truth.scored[0] = 0;
    truth.ambiguous[8] = 1;
    std::vector<float> measured(kPixels, 1.0f);
    measured[0] = measured[8] = 0.0f;
    const auto rgba = tinted(std::array{DrawnLight{measured, &truth}});
    EXPECT_EQ(tint_at(rgba, 0), tint_at(rgba, kMiddle));
    const auto ambiguous = tint_at(rgba, 8);
    EXPECT_EQ(ambiguous[0], ambiguous[2]);
    EXPECT_GT(ambiguous[0], 0);
    EXPECT_LT(ambiguous[3], 128);
    measured[kMiddle] = std::numeric_limits<float>::quiet_NaN();
    const auto uncovered = tint_at(tinted(std::array{DrawnLight{measured, &truth}}), kMiddle);
    EXPECT_EQ(uncovered[3], 255);
    EXPECT_GT(uncovered[1], 150) << "yellow";
}

}  // namespace
}  // namespace gnomon::truth
