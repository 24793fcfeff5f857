// Skins, morph targets and animations as the loader hands them on, and what it makes of odd ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/mesh/deformer.h"
#include "tests/unit/assets/gltf_builder.h"

namespace gnomon::test {
namespace {

using assets::AnimatedProperty;
using assets::Interpolation;
using assets::SceneData;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SceneData loaded(const GltfBuilder& builder) {
    auto scene = load(builder.gltf());
    EXPECT_TRUE(scene) << to_line(scene.error());
    return scene ? std::move(scene).value() : SceneData{};
}

json& attributes(GltfBuilder& builder) { return builder.doc["meshes"][0]["primitives"][0]["attributes"]; }

/// Adds an animation of one channel to `builder`.
void animate(GltfBuilder& builder, const char* path, int times, int values, const char* interpolation = "LINEAR",
             int node = 0) {
    const json target = {{"node", node}, {"path", path}};
    builder.push("animations",
                 {{"name", "move"},
                  {"samplers", json::array({{{"input", times}, {"output", values}, {"interpolation", interpolation}}})},
                  {"channels", json::array({{{"sampler", 0}, {"target", target}}})}});
}

TEST(SkinImport, JointsWeightsAndBindMatricesArriveInTheirOrder) {
    GltfBuilder builder = skinned_triangle();
    builder.push("nodes", {{"name", "second"}});
    std::vector<float> matrices = {1, 0, 0, 0, 0,  1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1,
                                   0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    builder.doc["skins"][0] = {{"joints", {2, 1}}, {"inverseBindMatrices", builder.add_accessor(matrices, "MAT4")}};
    attributes(builder)["JOINTS_0"] = builder.add_accessor<std::uint16_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    attributes(builder)["WEIGHTS_0"] =
        builder.add_accessor<std::uint8_t>({51, 204, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}, "VEC4", true);
    const SceneData scene = loaded(builder);
    EXPECT_THAT(scene.warnings, IsEmpty());
    ASSERT_EQ(scene.skins.size(), 1u);
    EXPECT_THAT(scene.skins[0].joints, ElementsAre(2, 1));
    EXPECT_EQ(scene.skins[0].inverse_bind[0][3], glm::dvec3(5.0, 6.0, 7.0));
    EXPECT_EQ(scene.skins[0].inverse_bind[1][0], glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(scene.nodes[0].skin, 0);
    const assets::Deformer& deformer = *scene.meshes[0].deformer;
    EXPECT_THAT(deformer.first_influence, ElementsAre(0u, 2u, 3u, 4u));
    EXPECT_EQ(deformer.influences[1].joint, 1u);
    EXPECT_FLOAT_EQ(deformer.influences[0].weight, 0.2f);
    EXPECT_FLOAT_EQ(deformer.influences[1].weight, 0.8f);
    EXPECT_EQ(deformer.joint_bounds_ms.size(), 2u);
    EXPECT_EQ(scene.meshes[0].shape, nullptr) << "a tree of the mesh at rest would lie about it bent";
}

TEST(SkinImport, WithoutBindMatricesTheyAreTheUnit) {
    const SceneData scene = loaded(skinned_triangle());
    EXPECT_THAT(scene.skins[0].inverse_bind, ElementsAre(glm::dmat4x3(1.0)));
}

TEST(SkinImport, WeightsAreScaledToSumToOneAndThoseWithoutAnyFollowTheirFirstJoint) {
    GltfBuilder builder = skinned_triangle();
    attributes(builder)["WEIGHTS_0"] = builder.add_accessor<float>({1, 3, 0, 0, -1, 0.5f, 0, 0, 0, 0, 0, 0}, "VEC4");
    const SceneData scene = loaded(builder);
    const auto& influences = scene.meshes[0].deformer->influences;
    ASSERT_EQ(influences.size(), 4u);
    EXPECT_EQ(influences[0].weight, 0.25f);
    EXPECT_EQ(influences[1].weight, 0.75f);
    EXPECT_EQ(influences[2].weight, 1.0f);
    EXPECT_EQ(influences[3].weight, 1.0f);
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("weights below 0 count as 0")));
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("do not sum to 1")));
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("without any weight")));
}

TEST(SkinImport, AJointOutOfRangeWithoutWeightDoesNotMatter) {
    GltfBuilder builder = skinned_triangle();
    attributes(builder)["JOINTS_0"] =
        builder.add_accessor<std::uint8_t>({0, 200, 9, 9, 0, 9, 9, 9, 0, 9, 9, 9}, "VEC4");
    EXPECT_EQ(loaded(builder).meshes[0].deformer->joint_bounds_ms.size(), 1u);
}

TEST(SkinImport, FurtherNodesGetTheirOwnMeshAndThoseWithoutASkinAStillOne) {
    GltfBuilder builder = skinned_triangle();
    builder.push("nodes", {{"mesh", 0}, {"skin", 0}});
    builder.push("nodes", {{"mesh", 0}});
    builder.push("nodes", {{"mesh", 0}});
    const SceneData scene = loaded(builder);
    ASSERT_EQ(scene.meshes.size(), 3u);
    EXPECT_NE(scene.nodes[0].mesh, scene.nodes[2].mesh);
    EXPECT_EQ(scene.meshes[0].deformer, scene.meshes[static_cast<std::size_t>(scene.nodes[2].mesh)].deformer);
    EXPECT_EQ(scene.nodes[3].mesh, scene.nodes[4].mesh);
    const assets::Mesh& still = scene.meshes[static_cast<std::size_t>(scene.nodes[3].mesh)];
    EXPECT_EQ(still.deformer, nullptr);
    EXPECT_NE(still.shape, nullptr);
}

TEST(SkinImport, ASkinWhoseJointsTheSceneLacksIsLeftOutWithAWarning) {
    GltfBuilder builder = skinned_triangle();
    builder.doc["scenes"] = json::array({{{"nodes", {0}}}});
    const SceneData scene = loaded(builder);
    EXPECT_EQ(scene.nodes[0].skin, assets::kNone);
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("does not reach all of its joints")));
}

TEST(MorphImport, TargetsAndWeightsComeFromTheNodeElseFromItsMesh) {
    GltfBuilder builder = triangle();
    const int bulge = builder.add_accessor<float>({0, 0, 1, 0, 0, 2, 0, 0, -3}, "VEC3");
    builder.doc["meshes"][0]["primitives"][0]["targets"] =
        json::array({{{"POSITION", bulge}}, {{"POSITION", bulge}, {"NORMAL", bulge}}});
    builder.doc["meshes"][0]["weights"] = {0.25, 0.5};
    builder.push("nodes", {{"mesh", 0}, {"weights", {1.0, -1.0}}});
    const SceneData scene = loaded(builder);
    EXPECT_THAT(scene.nodes[0].morph_weights, ElementsAre(0.25f, 0.5f));
    EXPECT_THAT(scene.nodes[1].morph_weights, ElementsAre(1.0f, -1.0f));
    EXPECT_NE(scene.nodes[0].mesh, scene.nodes[1].mesh);
    const assets::Deformer& deformer = *scene.meshes[0].deformer;
    EXPECT_FALSE(deformer.has_skin());
    ASSERT_EQ(deformer.targets.size(), 2u);
    EXPECT_EQ(deformer.targets[0].reach.min, glm::dvec3(0.0, 0.0, -3.0));
    EXPECT_EQ(deformer.targets[0].reach.max, glm::dvec3(0.0, 0.0, 2.0));
    EXPECT_THAT(deformer.targets[0].normals, IsEmpty());
    EXPECT_EQ(deformer.targets[1].normals.size(), 3u);
}

TEST(AnimationImport, KeysArriveAsTheyStandAndShortIntegersAsShares) {
    GltfBuilder builder = triangle();
    const int times = builder.add_accessor<float>({0.5f, 1.5f}, "SCALAR");
    animate(builder, "translation", times, builder.add_accessor<float>({1, 2, 3, 4, 5, 6}, "VEC3"), "STEP");
    animate(builder, "rotation", times,
            builder.add_accessor<std::int16_t>({0, 0, 0, 32767, 0, 32767, 0, 0}, "VEC4", true));
    const SceneData scene = loaded(builder);
    EXPECT_THAT(scene.warnings, IsEmpty());
    ASSERT_EQ(scene.animations.size(), 2u);
    EXPECT_EQ(scene.animations[0].name, "move");
    const assets::AnimationChannel& slide = scene.animations[0].channels.at(0);
    EXPECT_EQ(slide.property, AnimatedProperty::translation);
    EXPECT_EQ(slide.interpolation, Interpolation::step);
    EXPECT_THAT(slide.times_s, ElementsAre(0.5f, 1.5f));
    EXPECT_THAT(slide.values, ElementsAre(1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f));
    EXPECT_THAT(scene.animations[1].channels.at(0).values, ElementsAre(0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f, 0.0f));
}

struct OddChannel {
    const char* name;
    const char* warning;
    void (*make)(GltfBuilder&);
};
class OddChannels : public testing::TestWithParam<OddChannel> {};

TEST_P(OddChannels, AreLeftOutWithAWarningAndTheSceneStillLoads) {
    GltfBuilder builder = triangle();
    GetParam().make(builder);
    const SceneData scene = loaded(builder);
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_THAT(scene.animations[0].channels, IsEmpty());
    EXPECT_THAT(scene.warnings, Contains(HasSubstr(GetParam().warning)));
}

const OddChannel kOddChannels[] = {
    {"TimesGoBack", "times do not rise",
     [](GltfBuilder& b) {
         animate(b, "scale", b.add_accessor<float>({1, 0}, "SCALAR"),
                 b.add_accessor<float>({1, 1, 1, 2, 2, 2}, "VEC3"));
     }},
    {"TimesAreVectors", "times are not single floats", [](GltfBuilder& b) { animate(b, "scale", 0, 0); }},
    {"FewerValuesThanTimes", "not as many",
     [](GltfBuilder& b) {
         animate(b, "scale", b.add_accessor<float>({0, 1}, "SCALAR"), b.add_accessor<float>({1, 1, 1}, "VEC3"));
     }},
    {"CubicWithoutTangents", "not as many",
     [](GltfBuilder& b) {
         animate(b, "scale", b.add_accessor<float>({0, 1}, "SCALAR"), b.add_accessor<float>({1, 1, 1, 2, 2, 2}, "VEC3"),
                 "CUBICSPLINE");
     }},
    {"RotationOfThreeNumbers", "a type that glTF does not allow",
     [](GltfBuilder& b) {
         animate(b, "rotation", b.add_accessor<float>({0, 1, 2}, "SCALAR"), 0);
     }},
    {"RotationWithoutLength", "a rotation has no length",
     [](GltfBuilder& b) {
         animate(b, "rotation", b.add_accessor<float>({0}, "SCALAR"), b.add_accessor<float>({0, 0, 0, 0}, "VEC4"));
     }},
    {"WeightsOfNothing", "has no morph targets",
     [](GltfBuilder& b) {
         animate(b, "weights", b.add_accessor<float>({0}, "SCALAR"), b.add_accessor<float>({1}, "SCALAR"));
     }},
    {"UnknownPath", "none of glTF 2.0",
     [](GltfBuilder& b) {
         animate(b, "colour", b.add_accessor<float>({0}, "SCALAR"), b.add_accessor<float>({1}, "SCALAR"));
     }},
};
INSTANTIATE_TEST_SUITE_P(Crafted, OddChannels, testing::ValuesIn(kOddChannels),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(AnimationImport, AChannelWithoutNodeOrOfANodeElsewhereMovesNothing) {
    GltfBuilder builder = triangle();
    builder.push("nodes", json::object());
    builder.doc["scenes"] = json::array({{{"nodes", {0}}}});
    const int times = builder.add_accessor<float>({0}, "SCALAR");
    animate(builder, "scale", times, builder.add_accessor<float>({1, 1, 1}, "VEC3"), "LINEAR", 1);
    animate(builder, "scale", times, builder.add_accessor<float>({1, 1, 1}, "VEC3"));
    builder.doc["animations"][1]["channels"][0]["target"].erase("node");
    const SceneData scene = loaded(builder);
    EXPECT_THAT(scene.animations[0].channels, IsEmpty());
    EXPECT_THAT(scene.animations[1].channels, IsEmpty());
    EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(AnimationImport, OfTwoChannelsForOnePropertyTheFirstIsKept) {
    GltfBuilder builder = triangle();
    const int times = builder.add_accessor<float>({0}, "SCALAR");
    animate(builder, "scale", times, builder.add_accessor<float>({1, 1, 1}, "VEC3"));
    json& animation = builder.doc["animations"][0];
    animation["samplers"].push_back({{"input", times}, {"output", builder.add_accessor<float>({2, 2, 2}, "VEC3")}});
    animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", 0}, {"path", "scale"}}}});
    const SceneData scene = loaded(builder);
    ASSERT_EQ(scene.animations[0].channels.size(), 1u);
    EXPECT_EQ(scene.animations[0].channels[0].values[0], 1.0f);
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("another channel moves the same")));
}

}  // namespace
}  // namespace gnomon::test
