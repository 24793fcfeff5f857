#include "bench/compare/crop_images.h"

#include <gtest/gtest.h>

#include "systems/truth/error_colours.h"

namespace gnomon::bench {
namespace {

using truth::Colour;
using truth::error_colour;
using truth::soft_error_colour;

constexpr glm::uvec2 kSize_px{640, 360};

/// Makes a truth that is lit except for a chequered square with its lower corner at `low`.
oracle::LightTruth chequered(glm::uvec2 low, std::uint32_t side_px) {
    oracle::LightTruth truth;
    const std::size_t count = std::size_t{kSize_px.x} * kSize_px.y;
    truth.visibility.assign(count, 1.0f);
    truth.scored.assign(count, 1);
    truth.ambiguous.assign(count, 0);
    for (std::uint32_t y = low.y; y < low.y + side_px; ++y)
        for (std::uint32_t x = low.x; x < low.x + side_px; ++x)
            truth.visibility[std::size_t{y} * kSize_px.x + x] = static_cast<float>((x + y) % 2);
    return truth;
}

TEST(RowPictures, ShowThePartWithMostEdgesOfTheTruth) {
    constexpr std::uint32_t kSide_px = 20;
    for (const glm::uvec2 low : {glm::uvec2(0, 0), glm::uvec2(300, 200), glm::uvec2(600, 330)}) {
        const glm::uvec2 part = shown_part(chequered(low, kSide_px), kSize_px);
        EXPECT_LE(part.x + kShownPart_px.x, kSize_px.x);
        EXPECT_LE(part.y + kShownPart_px.y, kSize_px.y);
        // Places are tried every 16 px: at the far border less than that may be missing.
        EXPECT_LE(part.x, low.x);
        EXPECT_LE(part.y, low.y);
        EXPECT_GT(part.x + kShownPart_px.x, low.x);
        EXPECT_GT(part.y + kShownPart_px.y, low.y);
    }
}

TEST(RowPictures, EdgesThatAreNotScoredDoNotCount) {
    oracle::LightTruth truth = chequered({600, 330}, 20);
    truth.scored.assign(truth.scored.size(), 0);
    EXPECT_EQ(shown_part(truth, kSize_px), glm::uvec2(0, 0));
}

TEST(RowPictures, APictureThatIsSmallerIsShownWhole) {
    oracle::LightTruth truth;
    truth.visibility.assign(16 * 9, 1.0f);
    truth.scored.assign(16 * 9, 1);
    EXPECT_EQ(shown_part(truth, {16, 9}), glm::uvec2(0, 0));
}

TEST(HeatColours, RedIsMissingLightAndBlueTooMuchForBothTruths) {
    for (const auto& colour_of : {error_colour, soft_error_colour}) {
        const Colour missing = colour_of({1.0f, 0.0f, true, false}), surplus = colour_of({0.0f, 1.0f, true, false});
        EXPECT_GT(missing[0], missing[2]);
        EXPECT_GT(surplus[2], surplus[0]);
        EXPECT_NE(colour_of({1.0f, 1.0f, true, false}), missing);
        EXPECT_EQ(colour_of({1.0f, 0.0f, false, false}), colour_of({1.0f, 1.0f, false, false}));
        EXPECT_NE(colour_of({1.0f, -1.0f, true, false}), missing);
    }
    EXPECT_NE(error_colour({1.0f, 0.0f, true, true}), error_colour({1.0f, 0.0f, true, false}));
}

TEST(HeatColours, ASoftErrorGrowsWithTheDifference) {
    std::uint8_t last = 0;
    for (const float measured : {1.0f, 0.75f, 0.5f, 0.25f, 0.0f}) {
        const std::uint8_t red = soft_error_colour({1.0f, measured, true, false})[0];
        EXPECT_GE(red, last);
        last = red;
    }
    EXPECT_GT(last, 200);
}

}  // namespace
}  // namespace gnomon::bench
