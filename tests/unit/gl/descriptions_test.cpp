#include <gmock/gmock.h>

#include "engine/gl/device_recording.h"
#include "engine/gl/validate.h"

namespace gnomon::gl {
namespace {

const DeviceInfo kInfo = RecordingDevice::default_info();

TEST(TextureBytes, AFlatTextureIsWidthTimesHeightTimesTexel) {
    EXPECT_EQ(byte_size({.format = Format::d32f, .width = 1024, .height = 512}), 1024u * 512 * 4);
    EXPECT_EQ(byte_size({.format = Format::d16, .width = 1024, .height = 512}), 1024u * 512 * 2);
}

TEST(TextureBytes, EveryLayerAndFaceCounts) {
    EXPECT_EQ(byte_size({.kind = TextureKind::array, .format = Format::d24, .width = 8, .height = 8, .layers = 3}),
              8u * 8 * 4 * 3);
    EXPECT_EQ(byte_size({.kind = TextureKind::cube, .format = Format::d32f, .width = 8, .height = 8, .layers = 1}),
              8u * 8 * 4 * 6);
}

TEST(TextureBytes, AFullChainEndsAtOneTexel) {
    const TextureDesc desc{.format = Format::r8, .width = 8, .height = 2, .mips = 0};
    EXPECT_EQ(mip_count(desc), 4u);
    EXPECT_EQ(byte_size(desc), 8u * 2 + 4 * 1 + 2 * 1 + 1);
    EXPECT_EQ(mip_count({.width = 9, .height = 1, .mips = 0}), 4u);
}

TEST(TextureBytes, SizesBeyond32BitsDoNotWrap) {
    EXPECT_EQ(byte_size({.kind = TextureKind::cube, .format = Format::d32f, .width = 16384, .height = 16384}),
              std::uint64_t{16384} * 16384 * 4 * 6);
}

TEST(BufferDescriptions, WhatIsReadBackBeginsEmpty) {
    EXPECT_EQ(check_buffer({.size = 4, .use = BufferUse::read_back}, 0), Failure::none);
    EXPECT_EQ(check_buffer({.size = 4, .use = BufferUse::read_back}, 4), Failure::invalid_value);
    EXPECT_EQ(check_buffer({.size = 4, .use = BufferUse::updated}, 4), Failure::none);
}

TEST(Formats, OnlyTheFiveDepthFormatsAreDepthAndTravelAsFloats) {
    for (int i = 0; i <= static_cast<int>(Format::d32f_s8); ++i) {
        const auto format = static_cast<Format>(i);
        const bool depth = format == Format::d16 || format == Format::d24 || format == Format::d32f ||
                           format == Format::d24_s8 || format == Format::d32f_s8;
        EXPECT_EQ(is_depth(format), depth) << to_text(format);
        EXPECT_EQ(transfer_bytes(format), depth ? 4u : texel_bytes(format)) << to_text(format);
        EXPECT_GT(texel_bytes(format), 0u);
    }
}

TEST(TextureCheck, LimitsAreInclusive) {
    EXPECT_EQ(check_texture({.width = 16384, .height = 1}, kInfo, 0), Failure::none);
    EXPECT_EQ(check_texture({.width = 16385, .height = 1}, kInfo, 0), Failure::invalid_value);
    EXPECT_EQ(check_texture({.kind = TextureKind::array, .layers = 2048}, kInfo, 0), Failure::none);
    EXPECT_EQ(check_texture({.kind = TextureKind::array, .layers = 2049}, kInfo, 0), Failure::invalid_value);
}

TEST(TextureCheck, CubesObeyTheirOwnLimit) {
    DeviceInfo info = kInfo;
    info.max_cube_px = 256;
    EXPECT_EQ(check_texture({.kind = TextureKind::cube, .width = 256, .height = 256}, info, 0), Failure::none);
    EXPECT_EQ(check_texture({.kind = TextureKind::cube, .width = 512, .height = 512}, info, 0), Failure::invalid_value);
    EXPECT_EQ(check_texture({.kind = TextureKind::flat, .width = 512, .height = 512}, info, 0), Failure::none);
}

TEST(TextureCheck, ShapesThatDoNotExistAreRefused) {
    EXPECT_EQ(check_texture({.width = 0, .height = 4}, kInfo, 0), Failure::invalid_value);
    EXPECT_EQ(check_texture({.width = 4, .height = 0}, kInfo, 0), Failure::invalid_value);
    EXPECT_EQ(check_texture({.kind = TextureKind::cube, .width = 4, .height = 8}, kInfo, 0), Failure::invalid_value);
    EXPECT_EQ(check_texture({.kind = TextureKind::flat, .layers = 2}, kInfo, 0), Failure::invalid_value);
    EXPECT_EQ(check_texture({.kind = TextureKind::array, .layers = 0}, kInfo, 0), Failure::invalid_value);
    EXPECT_EQ(check_texture({.width = 4, .height = 4, .mips = 3}, kInfo, 0), Failure::none);
    EXPECT_EQ(check_texture({.width = 4, .height = 4, .mips = 4}, kInfo, 0), Failure::invalid_value);
}

TEST(TextureCheck, PixelsAreAllOfMipZeroOrNone) {
    const TextureDesc desc{.kind = TextureKind::array, .format = Format::d16, .width = 2, .height = 2, .layers = 3};
    EXPECT_EQ(check_texture(desc, kInfo, 2 * 2 * 3 * 4), Failure::none);  // depth travels as floats
    EXPECT_EQ(check_texture(desc, kInfo, 2 * 2 * 3 * 2), Failure::invalid_value);
}

TEST(BufferCheck, FixedBuffersNeedTheirBytes) {
    EXPECT_EQ(check_buffer({.size = 8, .use = BufferUse::fixed}, 8), Failure::none);
    EXPECT_EQ(check_buffer({.size = 8, .use = BufferUse::fixed}, 0), Failure::invalid_value);
    EXPECT_EQ(check_buffer({.size = 8, .use = BufferUse::updated}, 0), Failure::none);
    EXPECT_EQ(check_buffer({.size = 8, .use = BufferUse::updated}, 7), Failure::invalid_value);
    EXPECT_EQ(check_buffer({.size = 0}, 0), Failure::invalid_value);
}

TEST(AttachmentCheck, LayersMustExist) {
    const TextureDesc flat{}, array{.kind = TextureKind::array, .layers = 2}, cube{.kind = TextureKind::cube};
    EXPECT_EQ(check_attachment({{1}, -1}, &flat), Failure::none);
    EXPECT_EQ(check_attachment({{1}, 1}, &flat), Failure::incomplete_target);
    EXPECT_EQ(check_attachment({{1}, 1}, &array), Failure::none);
    EXPECT_EQ(check_attachment({{1}, 2}, &array), Failure::incomplete_target);
    EXPECT_EQ(check_attachment({{1}, -1}, &array), Failure::incomplete_target);
    EXPECT_EQ(check_attachment({{1}, 5}, &cube), Failure::none);
    EXPECT_EQ(check_attachment({{1}, 6}, &cube), Failure::incomplete_target);
    EXPECT_EQ(check_attachment({{1}, -2}, &flat), Failure::incomplete_target);
    EXPECT_EQ(check_attachment({{1}, kAllLayers}, &array), Failure::none);
    EXPECT_EQ(check_attachment({{1}, kAllLayers}, &cube), Failure::none);
    EXPECT_EQ(check_attachment({{1}, -3}, &cube), Failure::incomplete_target);
    EXPECT_EQ(check_attachment({{1}, 0}, nullptr), Failure::invalid_value);
}

TEST(Ranges, SumsThatOverflowAreOutOfRange) {
    EXPECT_TRUE(in_range(4, 4, 8));
    EXPECT_FALSE(in_range(4, 5, 8));
    EXPECT_FALSE(in_range(~std::uint64_t{0}, 2, 8));
    EXPECT_TRUE(in_target({0, 0, 8, 4}, 8, 4));
    EXPECT_FALSE(in_target({1, 0, 8, 4}, 8, 4));
    EXPECT_FALSE(in_target({-1, 0, 4, 4}, 8, 4));
    EXPECT_FALSE(in_target({0, 0, 0, 4}, 8, 4));
    EXPECT_FALSE(in_target({2147483647, 0, 2147483647, 4}, 8, 4));
}

TEST(Texts, EveryFailureAndMisuseHasItsOwnName) {
    for (int i = 0; i <= static_cast<int>(Failure::context_lost); ++i) {
        EXPECT_STRNE(to_text(static_cast<Failure>(i)), "?");
    }
    for (int i = 0; i <= static_cast<int>(Misuse::leak); ++i) EXPECT_STRNE(to_text(static_cast<Misuse>(i)), "?");
}

}  // namespace
}  // namespace gnomon::gl
