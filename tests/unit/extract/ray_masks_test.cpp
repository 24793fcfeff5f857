#include "systems/extract/ray_masks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace gnomon {
namespace {

constexpr std::uint32_t kSide = 16;

assets::Texture texture(const std::function<bool(std::uint32_t, std::uint32_t)>& is_left, std::uint8_t alpha = 255) {
    assets::Texture t;
    t.width = t.height = kSide;
    for (std::uint32_t y = 0; y < kSide; ++y)
        for (std::uint32_t x = 0; x < kSide; ++x)
            t.rgba.insert(t.rgba.end(), {0, 0, 0, is_left(x, y) ? alpha : std::uint8_t{0}});
    return t;
}

float chord(const std::function<bool(std::uint32_t, std::uint32_t)>& is_left) {
    return mean_chord_texel(texture(is_left), 1.0f, 0.5f);
}

TEST(MeanChord, OfSquaresIsTheirSide) {
    for (const std::uint32_t side : {1u, 2u, 4u, 8u})
        EXPECT_EQ(chord([&](std::uint32_t x, std::uint32_t y) { return (x / side + y / side) % 2 == 0; }),
                  static_cast<float>(side));
}

TEST(MeanChord, OfOneTexelIsOne) {
    EXPECT_EQ(chord([](std::uint32_t x, std::uint32_t y) { return x == 3 && y == 15; }), 1.0f);
}

TEST(MeanChord, GoesOnOverTheTexturesBorder) {
    // Two texels at each border are one of four by four.
    const auto near_border = [](std::uint32_t a) { return a < 2 || a >= kSide - 2; };
    EXPECT_EQ(chord([&](std::uint32_t x, std::uint32_t y) { return near_border(x) && near_border(y); }), 4.0f);
}

TEST(MeanChord, OfStripesIsTwiceTheirWidth) {
    // Along them nothing ends.
    EXPECT_EQ(chord([](std::uint32_t x, std::uint32_t) { return x / 4 % 2 == 0; }), 8.0f);
}

TEST(MeanChord, OfNothingIsZeroAndOfAllInfinite) {
    EXPECT_EQ(chord([](std::uint32_t, std::uint32_t) { return false; }), 0.0f);
    EXPECT_TRUE(std::isinf(chord([](std::uint32_t, std::uint32_t) { return true; })));
}

TEST(MeanChord, CountsWhatTheMaterialLeaves) {
    const assets::Texture half = texture([](std::uint32_t x, std::uint32_t y) { return (x + y) % 2 == 0; }, 128);
    EXPECT_EQ(mean_chord_texel(half, 1.0f, 0.5f), 1.0f);
    EXPECT_EQ(mean_chord_texel(half, 0.9f, 0.5f), 0.0f) << "a material's own alpha cuts";
    EXPECT_TRUE(std::isinf(mean_chord_texel(half, 1.0f, 0.0f))) << "a cutoff of 0 cuts nothing";
}

}  // namespace
}  // namespace gnomon
