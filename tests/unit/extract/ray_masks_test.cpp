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

/// Returns a library of masked triangles: `count` in each mesh, all corners at u = the mesh's number.
assets::MeshLibrary masked_library(std::initializer_list<std::uint32_t> counts) {
    assets::MeshLibrary library;
    library.materials.push_back({.name = "masked", .alpha_mode = assets::AlphaMode::mask});
    for (const std::uint32_t count : counts) {
        assets::Mesh mesh;
        mesh.vertices.resize(3);
        for (assets::Vertex& vertex : mesh.vertices) vertex.uv.x = static_cast<float>(library.meshes.size());
        for (std::uint32_t i = 0; i < 3 * count; ++i) mesh.indices.push_back(i % 3);
        library.meshes.push_back(std::move(mesh));
    }
    return library;
}

TEST(RayMasks, ReuseTheWordsOfMeshesThatWentAndLeaveOthersInPlace) {
    assets::MeshLibrary library = masked_library({4, 4, 4});
    RayMasks masks(library);
    const RayMasks::Place first = masks.place(0, 0, 0), second = masks.place(1, 0, 0), third = masks.place(2, 0, 0);
    const std::size_t words = masks.words().size();
    masks.forget_changes();
    masks.forget(1);
    library.replace(1, masked_library({3}).meshes[0]);
    const RayMasks::Place again = masks.place(1, 0, 0);
    EXPECT_EQ(again.uvs, second.uvs);
    EXPECT_EQ(again.mask, second.mask);
    EXPECT_EQ(masks.words()[again.uvs], 0u) << "the new mesh's own u of 0";
    EXPECT_EQ(masks.words().size(), words);
    ASSERT_EQ(masks.changes().size(), 1u);
    EXPECT_EQ(masks.changes()[0].first, second.uvs);
    EXPECT_EQ(masks.changes()[0].count, 3u * 6);
    EXPECT_EQ(masks.place(0, 0, 0).uvs, first.uvs);
    masks.forget(2);
    EXPECT_EQ(masks.words().size(), third.uvs - 6) << "ends with the last mesh; the second is 6 words shorter";
    EXPECT_NE(first.uvs, second.uvs);
}

}  // namespace
}  // namespace gnomon
