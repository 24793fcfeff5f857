#include "tests/oracle/alpha_mask.h"

#include <gtest/gtest.h>

namespace gnomon::oracle {
namespace {

/// Makes two texels side by side, with alpha 0 and 255.
assets::Texture two_texels() {
    assets::Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.rgba = {9, 9, 9, 0, 9, 9, 9, 255};
    return texture;
}

TEST(AlphaMask, InterpolatesBetweenTexelCentres) {
    const assets::Texture texture = two_texels();
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {0.25, 0.5}), 0.0);
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {0.75, 0.5}), 1.0);
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {0.5, 0.5}), 0.5);
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {0.625, 0.5}), 0.75);
}

TEST(AlphaMask, TakesTheNearestTexelWhenTheTextureAsksForIt) {
    assets::Texture texture = two_texels();
    texture.linear_filter = false;
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {0.49, 0.5}), 0.0);
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {0.51, 0.5}), 1.0);
}

TEST(AlphaMask, WrapsAsTheTextureSays) {
    assets::Texture texture = two_texels();
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {1.25, 0.5}), 0.0);
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {-0.25, 0.5}), 1.0);
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {1.0, 0.5}), 0.5);
    texture.wrap_u = assets::TextureWrap::mirror;
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {1.25, 0.5}), 1.0);
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {1.0, 0.5}), 1.0);
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {-0.25, 0.5}), 0.0);
    texture.wrap_u = assets::TextureWrap::clamp;
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {7.0, 0.5}), 1.0);
    EXPECT_DOUBLE_EQ(sample_alpha(texture, {-7.0, 0.5}), 0.0);
}

TEST(AlphaMask, ComparesTheProductWithTheCutoffAndIgnoresUnmaskedMaterials) {
    assets::MeshLibrary library;
    library.textures.push_back(two_texels());
    assets::Material material;
    material.base_colour_texture = 0;
    EXPECT_TRUE(passes_mask(library, material, {0.25, 0.5}));
    material.alpha_mode = assets::AlphaMode::mask;
    EXPECT_FALSE(passes_mask(library, material, {0.25, 0.5}));
    EXPECT_TRUE(passes_mask(library, material, {0.5, 0.5})) << "equal to the cutoff stays";
    material.base_colour.a = 0.9f;
    EXPECT_FALSE(passes_mask(library, material, {0.5, 0.5}));
    EXPECT_TRUE(passes_mask(library, material, {0.75, 0.5}));
    material.base_colour_texture = assets::kNone;
    EXPECT_TRUE(passes_mask(library, material, {0.25, 0.5}));
}

TEST(AlphaMask, ATextureWithoutTexelsIsOpaque) { EXPECT_DOUBLE_EQ(sample_alpha(assets::Texture{}, {0.5, 0.5}), 1.0); }

}  // namespace
}  // namespace gnomon::oracle
