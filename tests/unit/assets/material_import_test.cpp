#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/unit/assets/gltf_builder.h"

namespace gnomon::test {
namespace {

using assets::AlphaMode;
using assets::kNone;
using assets::SceneData;
using testing::ElementsAre;
using testing::HasSubstr;

SceneData loaded(const Bytes& bytes) {
    Result<SceneData> result = load(bytes);
    EXPECT_TRUE(result) << to_line(result.error());
    return result ? std::move(result).value() : SceneData{};
}

/// A PNG of 2 x 1 texels, RGBA: opaque red, then half-transparent blue. Written by hand: stored, not compressed.
const std::vector<std::uint8_t> kPng = {0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49,
                                        0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06,
                                        0x00, 0x00, 0x00, 0xF4, 0x22, 0x7F, 0x8A, 0x00, 0x00, 0x00, 0x14, 0x49, 0x44,
                                        0x41, 0x54, 0x78, 0x01, 0x01, 0x09, 0x00, 0xF6, 0xFF, 0x00, 0xFF, 0x00, 0x00,
                                        0xFF, 0x00, 0x00, 0xFF, 0x80, 0x0F, 0x7A, 0x03, 0x7E, 0x4A, 0x6E, 0x70, 0x0C,
                                        0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};

/// Makes the triangle with a masked material and its image in a buffer view.
GltfBuilder masked_triangle(const std::vector<std::uint8_t>& image) {
    GltfBuilder builder = triangle();
    const int view = builder.add_view(image.data(), image.size());
    builder.push("images", {{"bufferView", view}, {"mimeType", "image/png"}, {"name", "leaf"}});
    builder.push("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
    builder.push("textures", {{"source", 0}, {"sampler", 0}});
    builder.push("materials", {{"alphaMode", "MASK"},
                               {"alphaCutoff", 0.25},
                               {"doubleSided", true},
                               {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    const int uv = builder.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    const int other_uv = builder.add_accessor<float>({0, 0, 2, 0, 0, 2}, "VEC2");
    json& primitive = builder.doc["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = uv;
    primitive["attributes"]["TEXCOORD_1"] = other_uv;
    primitive["material"] = 0;
    return builder;
}

TEST(MaterialImport, ReadsFactorsAndModes) {
    GltfBuilder builder;
    builder.push("materials",
                 {{"name", "glass"},
                  {"alphaMode", "BLEND"},
                  {"emissiveFactor", {0.5, 0.25, 0}},
                  {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.75}}}});
    builder.push("materials", json::object());
    const SceneData scene = loaded(builder.gltf());
    ASSERT_EQ(scene.materials.size(), 2U);
    const auto& glass = scene.materials[0];
    EXPECT_EQ(glass.name, "glass");
    EXPECT_EQ(glass.alpha_mode, AlphaMode::blend);
    EXPECT_EQ(glass.emissive, glm::vec3(4, 2, 0));
    EXPECT_EQ(glass.base_colour, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_EQ(glass.metallic, 0.5F);
    EXPECT_EQ(glass.roughness, 0.75F);
    const auto& plain = scene.materials[1];
    EXPECT_EQ(plain.alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(plain.base_colour, glm::vec4(1));
    EXPECT_EQ(plain.metallic, 1.0F);
    EXPECT_EQ(plain.base_colour_texture, kNone);
    EXPECT_FALSE(plain.double_sided);
}

TEST(MaterialImport, ReadsTransmissionAndVolume) {
    const json pbr = {{"metallicFactor", 0}};
    const auto transmitting = [](double factor) { return json{{"transmissionFactor", factor}}; };
    GltfBuilder builder;
    builder.push("materials", {{"pbrMetallicRoughness", pbr},
                               {"extensions", {{"KHR_materials_transmission", transmitting(0.8)}}}});
    builder.push("materials", {{"pbrMetallicRoughness", pbr},
                               {"extensions",
                                {{"KHR_materials_transmission", transmitting(1.0)},
                                 {"KHR_materials_volume",
                                  {{"thicknessFactor", 2.0},
                                   {"attenuationDistance", 0.5},
                                   {"attenuationColor", {1.0, 0.25, 0.0}}}}}}});
    // A volume transmits nothing by itself; a metal transmits nothing.
    builder.push("materials", {{"pbrMetallicRoughness", pbr},
                               {"extensions", {{"KHR_materials_volume", {{"thicknessFactor", 1.0}}}}}});
    builder.push("materials", {{"extensions", {{"KHR_materials_transmission", transmitting(1.0)}}}});
    const SceneData scene = loaded(builder.gltf());
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
    EXPECT_EQ(scene.materials[0].transmission, glm::vec3(0.8F));
    EXPECT_TRUE(assets::transmits(scene.materials[0]));
    // Each of a body's two surfaces has half of its thickness: 0.25 to the power of 2 m / 0.5 m / 2.
    EXPECT_FLOAT_EQ(scene.materials[1].transmission.x, 1.0F);
    EXPECT_FLOAT_EQ(scene.materials[1].transmission.y, 0.0625F);
    EXPECT_FLOAT_EQ(scene.materials[1].transmission.z, 0.0F);
    EXPECT_FALSE(assets::transmits(scene.materials[2]));
    EXPECT_FALSE(assets::transmits(scene.materials[3]));
}

TEST(MaterialImport, TakesTransmissionOutOfRange) {
    GltfBuilder builder;
    builder.push("materials", {{"extensions",
                                {{"KHR_materials_transmission", {{"transmissionFactor", 7}}},
                                 {"KHR_materials_volume",
                                  {{"thicknessFactor", -1}, {"attenuationDistance", 0}, {"attenuationColor", {1, 1, 1}}}}}}});
    const SceneData scene = loaded(builder.gltf());
    EXPECT_EQ(scene.materials[0].transmission, glm::vec3(1.0F));
    EXPECT_FALSE(scene.warnings.empty());
}

TEST(MaterialImport, DecodesTheBaseColourTextureWithItsSampler) {
    const SceneData scene = loaded(masked_triangle(kPng).gltf());
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
    const auto& material = scene.materials.at(0);
    EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(material.alpha_cutoff, 0.25F);
    EXPECT_TRUE(material.double_sided);
    EXPECT_EQ(material.base_colour_texture, 0);
    ASSERT_EQ(scene.textures.size(), 1U);
    const auto& texture = scene.textures[0];
    EXPECT_EQ(texture.name, "leaf");
    EXPECT_EQ(texture.width, 2U);
    EXPECT_EQ(texture.height, 1U);
    EXPECT_THAT(texture.rgba, ElementsAre(255, 0, 0, 255, 0, 0, 255, 128));
    EXPECT_EQ(texture.wrap_u, assets::TextureWrap::clamp);
    EXPECT_EQ(texture.wrap_v, assets::TextureWrap::mirror);
    EXPECT_FALSE(texture.linear_filter);
}

TEST(MaterialImport, DecodesATextureOnceForAllItsMaterials) {
    GltfBuilder builder = masked_triangle(kPng);
    builder.push("materials", builder.doc["materials"][0]);
    const SceneData scene = loaded(builder.gltf());
    EXPECT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.materials.at(1).base_colour_texture, 0);
}

TEST(MaterialImport, MakesAMaskedMaterialOpaqueWhenItsImageIsMissingAndSaysSo) {
    std::vector<std::uint8_t> broken = kPng;
    broken[0] = 0;
    const SceneData scene = loaded(masked_triangle(broken).gltf());
    EXPECT_EQ(scene.materials.at(0).alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(scene.materials[0].base_colour_texture, kNone);
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("/images/0: texture left out"), HasSubstr("so it is opaque")));
}

TEST(MaterialImport, WarnsOfEveryImageThatCannotBeHad) {
    struct Case {
        json image;
        const char* warning;
    };
    const Case cases[] = {
        {{{"uri", "missing.png"}}, "uri.no_base_folder"},
        {{{"uri", "../secret.png"}}, "uri.escapes_folder"},
        {{{"uri", "%2e%2e/secret.png"}}, "uri.escapes_folder"},
        {{{"uri", "file:///etc/passwd"}}, "uri.scheme"},
        {{{"uri", "/etc/passwd"}}, "uri.absolute"},
        {{{"uri", "data:image/png;base64,!!!!"}}, "uri.base64"},
        {{{"uri", "data:image/png;base64,AAAA"}}, "unknown image type"},
        {json::object(), "image.no_source"},
    };
    for (const Case& c : cases) {
        GltfBuilder builder = masked_triangle(kPng);
        builder.doc["images"][0] = c.image;
        const SceneData scene = loaded(builder.gltf());
        ASSERT_EQ(scene.warnings.size(), 2U) << c.image;
        EXPECT_THAT(scene.warnings[0], HasSubstr(c.warning));
        EXPECT_EQ(scene.materials.at(0).alpha_mode, AlphaMode::opaque) << c.image;
    }
}

TEST(MaterialImport, RefusesAnImageWiderThanTheLimitFromItsHeaderAlone) {
    std::vector<std::uint8_t> wide = kPng;
    wide[18] = 0x20;  // width 0x2002: 8194
    const SceneData scene = loaded(masked_triangle(wide).gltf());
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_THAT(scene.warnings.at(0), HasSubstr("too large"));
}

TEST(MaterialImport, TakesTheTextureCoordinatesThatTheMaterialNames) {
    GltfBuilder builder = masked_triangle(kPng);
    EXPECT_EQ(loaded(builder.gltf()).meshes.at(0).vertices.at(1).uv, glm::vec2(1, 0));
    builder.doc["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
    EXPECT_EQ(loaded(builder.gltf()).meshes.at(0).vertices.at(1).uv, glm::vec2(2, 0));
}

TEST(MaterialImport, AppliesTextureTransforms) {
    GltfBuilder builder = masked_triangle(kPng);
    builder.doc["extensionsUsed"] = {"KHR_texture_transform"};
    builder.doc["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {10, 20}}, {"scale", {3, 5}}, {"rotation", std::acos(0.0)}};
    const auto vertices = loaded(builder.gltf()).meshes.at(0).vertices;
    // A quarter turn counter-clockwise with v down takes (1, 0) to (0, -1) and (0, 1) to (1, 0).
    EXPECT_NEAR(vertices.at(1).uv.x, 10.0F, 1e-5F);
    EXPECT_NEAR(vertices.at(1).uv.y, 17.0F, 1e-5F);
    EXPECT_NEAR(vertices.at(2).uv.x, 15.0F, 1e-5F);
    EXPECT_NEAR(vertices.at(2).uv.y, 20.0F, 1e-5F);
}

TEST(MaterialImport, TakesUnlitForWhatItSays) {
    GltfBuilder builder;
    builder.doc["extensionsUsed"] = {"KHR_materials_unlit"};
    builder.push("materials", {{"extensions", {{"KHR_materials_unlit", json::object()}}}});
    builder.push("materials", json::object());
    const SceneData scene = loaded(builder.gltf());
    ASSERT_EQ(scene.materials.size(), 2U);
    EXPECT_TRUE(scene.materials[0].unlit);
    EXPECT_FALSE(scene.materials[1].unlit);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(MaterialImport, ClampsFactorsWithAWarning) {
    GltfBuilder builder;
    builder.push("materials", {{"pbrMetallicRoughness", {{"metallicFactor", 3}, {"roughnessFactor", -1}}}});
    const SceneData scene = loaded(builder.gltf());
    EXPECT_EQ(scene.materials.at(0).metallic, 1.0F);
    EXPECT_EQ(scene.materials[0].roughness, 0.0F);
    EXPECT_EQ(scene.warnings.size(), 2U);
}

TEST(MaterialImport, NamesIgnoredExtensionsOnce) {
    GltfBuilder builder;
    builder.doc["extensionsUsed"] = {"EXT_clouds", "EXT_clouds", "KHR_materials_unlit"};
    EXPECT_THAT(loaded(builder.gltf()).warnings, ElementsAre("extension EXT_clouds is ignored"));
}

}  // namespace
}  // namespace gnomon::test
