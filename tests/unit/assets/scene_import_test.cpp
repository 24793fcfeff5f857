#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/unit/assets/gltf_builder.h"

namespace gnomon::test {
namespace {

using assets::kNone;
using assets::Node;
using assets::SceneData;
using testing::ElementsAre;
using testing::HasSubstr;

SceneData loaded_scene(const Bytes& bytes) {
    Result<SceneData> result = load(bytes);
    EXPECT_TRUE(result) << to_line(result.error());
    return result ? std::move(result).value() : SceneData{};
}

glm::dmat4 matrix_of(const Node& node) {
    return glm::scale(glm::translate(glm::dmat4(1.0), node.translation_m) * glm::mat4_cast(node.rotation), node.scale);
}

json numbers_of(const glm::dmat4& matrix) {
    json numbers = json::array();
    for (int i = 0; i < 16; ++i) numbers.push_back(matrix[i / 4][i % 4]);
    return numbers;
}

void expect_same(const glm::dmat4& a, const glm::dmat4& b, double tolerance) {
    for (int i = 0; i < 16; ++i) EXPECT_NEAR(a[i / 4][i % 4], b[i / 4][i % 4], tolerance) << "element " << i;
}

TEST(SceneImport, KeepsTranslationRotationAndScale) {
    GltfBuilder builder = triangle();
    builder.doc["nodes"][0].update(
        {{"translation", {1.5, 1e8, -3}}, {"rotation", {0, 0, 2, 0}}, {"scale", {1, -2, 0.5}}, {"name", "thing"}});
    const Node node = loaded_scene(builder.gltf()).nodes.at(0);
    EXPECT_EQ(node.name, "thing");
    EXPECT_EQ(node.translation_m, glm::dvec3(1.5, 1e8, -3));
    EXPECT_EQ(node.rotation, glm::dquat(0, 0, 0, 1)) << "w first, unit length";
    EXPECT_EQ(node.scale, glm::dvec3(1, -2, 0.5));
    EXPECT_EQ(node.mesh, 0);
}

TEST(SceneImport, DecomposesMatricesAlsoMirroredAndFlatOnes) {
    const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1.0), {4, 5, 6}), 0.7, {1, 2, 3});
    const glm::dvec3 scales[] = {{1, 1, 1},    {2, 3, 4}, {-2, 3, 4}, {2, -3, 4},     {2, 3, -4},
                                 {-2, -3, -4}, {0, 3, 4}, {2, 0, 4},  {2, 3, 0},      {0, 0, 4},
                                 {0, 3, 0},    {2, 0, 0}, {0, 0, 0},  {1e-4, 1, 1e4}, {1e5, 1e5, 1e5}};
    for (const glm::dvec3& scale : scales) {
        SCOPED_TRACE(testing::Message() << scale.x << ' ' << scale.y << ' ' << scale.z);
        const glm::dmat4 matrix = glm::scale(turned, scale);
        GltfBuilder builder = triangle();
        builder.doc["nodes"][0]["matrix"] = numbers_of(matrix);
        const Node node = loaded_scene(builder.gltf()).nodes.at(0);
        const double size = std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z), 1.0});
        expect_same(matrix_of(node), matrix, 1e-9 * size);
        const int negative = int{node.scale.x < 0} + int{node.scale.y < 0} + int{node.scale.z < 0};
        EXPECT_EQ(negative, scale.x * scale.y * scale.z < 0 ? 1 : 0);
    }
}

TEST(SceneImport, AcceptsMatricesWithTheRoundingOfFloats) {
    const glm::dmat4 exact = glm::scale(glm::rotate(glm::dmat4(1.0), 1.1, {3, -1, 2}), {7.0, 0.3, 2.0});
    GltfBuilder builder = triangle();
    builder.doc["nodes"][0]["matrix"] = numbers_of(glm::dmat4(glm::mat4(exact)));
    expect_same(matrix_of(loaded_scene(builder.gltf()).nodes.at(0)), exact, 1e-5);
}

TEST(SceneImport, OrdersParentsBeforeChildrenDepthFirst) {
    GltfBuilder builder;
    builder.doc["nodes"] = json::array({{{"name", "leaf"}},
                                        {{"name", "root"}, {"children", {3, 0}}},
                                        {{"name", "other"}},
                                        {{"name", "branch"}, {"children", {4}}},
                                        {{"name", "twig"}}});
    const SceneData scene = loaded_scene(builder.gltf());
    std::vector<std::string> names;
    std::vector<int> parents;
    for (const Node& node : scene.nodes) {
        names.push_back(node.name);
        parents.push_back(node.parent);
    }
    EXPECT_THAT(names, ElementsAre("root", "branch", "twig", "leaf", "other"));
    EXPECT_THAT(parents, ElementsAre(kNone, 0, 1, 0, kNone));
}

TEST(SceneImport, ShowsTheDefaultSceneElseTheFirst) {
    GltfBuilder builder;
    builder.doc["nodes"] = json::array({{{"name", "a"}}, {{"name", "b"}}});
    builder.doc["scenes"] = json::array({{{"nodes", {0}}}, {{"nodes", {1}}}});
    EXPECT_EQ(loaded_scene(builder.gltf()).nodes.at(0).name, "a");
    builder.doc["scene"] = 1;
    const SceneData scene = loaded_scene(builder.gltf());
    ASSERT_EQ(scene.nodes.size(), 1U);
    EXPECT_EQ(scene.nodes[0].name, "b");
}

TEST(SceneImport, ShowsASceneNodeThatHasAParentWithoutIt) {
    GltfBuilder builder;
    builder.doc["nodes"] = json::array({{{"name", "above"}, {"children", {1}}}, {{"name", "shown"}}});
    builder.doc["scenes"] = json::array({{{"nodes", {1}}}});
    const SceneData scene = loaded_scene(builder.gltf());
    ASSERT_EQ(scene.nodes.size(), 1U);
    EXPECT_EQ(scene.nodes[0].name, "shown");
    EXPECT_EQ(scene.nodes[0].parent, kNone);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("has a parent")));
}

TEST(SceneImport, KeepsSeveralInstancesOfOneMesh) {
    GltfBuilder builder = triangle();
    builder.push("nodes", {{"mesh", 0}, {"translation", {3, 0, 0}}});
    const SceneData scene = loaded_scene(builder.gltf());
    EXPECT_EQ(scene.meshes.size(), 1U);
    ASSERT_EQ(scene.nodes.size(), 2U);
    EXPECT_EQ(scene.nodes[0].mesh, 0);
    EXPECT_EQ(scene.nodes[1].mesh, 0);
}

TEST(SceneImport, LoadsAFileWithoutAnyScene) {
    const SceneData scene = loaded_scene(GltfBuilder{}.gltf());
    EXPECT_TRUE(scene.nodes.empty());
    EXPECT_EQ(scene.materials.size(), 1U) << "there is always a material";
}

GltfBuilder with_lights(const json& lights) {
    GltfBuilder builder;
    builder.doc["extensionsUsed"] = {"KHR_lights_punctual"};
    builder.doc["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        builder.push("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    return builder;
}

TEST(SceneImport, ReadsPunctualLights) {
    const GltfBuilder builder =
        with_lights({{{"type", "directional"}, {"intensity", 5e4}, {"color", {1, 0.5, 0.25}}, {"name", "sun"}},
                     {{"type", "point"}, {"range", 7}},
                     {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}, {"intensity", 0}},
                     {{"type", "spot"}, {"spot", json::object()}, {"extras", {{"shadow", false}}}}});
    const SceneData scene = loaded_scene(builder.gltf());
    ASSERT_EQ(scene.lights.size(), 4U);
    EXPECT_EQ(scene.lights[0].type, assets::LightType::directional);
    EXPECT_EQ(scene.lights[0].name, "sun");
    EXPECT_EQ(scene.lights[0].intensity, 5e4F);
    EXPECT_EQ(scene.lights[0].colour, glm::vec3(1, 0.5, 0.25));
    EXPECT_TRUE(scene.lights[0].casts_shadow);
    EXPECT_EQ(scene.lights[1].type, assets::LightType::point);
    EXPECT_EQ(scene.lights[1].range_m, 7.0F);
    EXPECT_EQ(scene.lights[1].intensity, 1.0F);
    EXPECT_EQ(scene.lights[2].type, assets::LightType::spot);
    EXPECT_EQ(scene.lights[2].inner_cone_rad, 0.1F);
    EXPECT_EQ(scene.lights[2].outer_cone_rad, 0.5F);
    EXPECT_FLOAT_EQ(scene.lights[3].outer_cone_rad, 0.785398163F);
    EXPECT_FALSE(scene.lights[3].casts_shadow);
    EXPECT_EQ(scene.nodes.at(2).light, 2);
}

TEST(SceneImport, ReadsAreaLightsAfterPunctualOnes) {
    GltfBuilder builder = with_lights({{{"type", "point"}}});
    builder.doc["extensionsUsed"].push_back("EXT_lights_area");
    builder.doc["extensions"]["EXT_lights_area"]["lights"] = {
        {{"type", "rect"}, {"size", 0.5}, {"rect", {{"aspect", 3}}}, {"intensity", 2000}, {"color", {1, 0.5, 0}}},
        {{"type", "disk"}, {"size", 0.5}, {"name", "panel"}},
        {{"type", "sphere"}, {"extras", {{"shadow", false}}}},
        {{"type", "tube"}, {"size", 1.2}, {"tube", {{"radius", 0.02}}}}};
    for (int i = 0; i < 4; ++i) builder.push("nodes", {{"extensions", {{"EXT_lights_area", {{"light", i}}}}}});
    const SceneData scene = loaded_scene(builder.gltf());
    ASSERT_EQ(scene.lights.size(), 5U);
    EXPECT_EQ(scene.lights[1].type, assets::LightType::rectangle);
    EXPECT_EQ(scene.lights[1].width_m, 1.5F);
    EXPECT_EQ(scene.lights[1].height_m, 0.5F);
    EXPECT_EQ(scene.lights[1].intensity, 2000.0F);
    EXPECT_EQ(scene.lights[1].colour, glm::vec3(1, 0.5, 0));
    EXPECT_EQ(scene.lights[2].type, assets::LightType::disc);
    EXPECT_EQ(scene.lights[2].radius_m, 0.25F);
    EXPECT_EQ(scene.lights[2].name, "panel");
    EXPECT_EQ(scene.lights[3].type, assets::LightType::sphere);
    EXPECT_EQ(scene.lights[3].radius_m, 0.5F);
    EXPECT_FALSE(scene.lights[3].casts_shadow);
    EXPECT_EQ(scene.lights[4].type, assets::LightType::tube);
    EXPECT_EQ(scene.lights[4].width_m, 1.2F);
    EXPECT_EQ(scene.lights[4].radius_m, 0.02F);
    EXPECT_EQ(scene.nodes.at(0).light, 0);
    EXPECT_EQ(scene.nodes.at(4).light, 4);
}

TEST(SceneImport, TakesAnAreaLightWithoutASizeAsOneThatShowsNothing) {
    GltfBuilder builder;
    builder.doc["extensionsUsed"] = {"EXT_lights_area"};
    builder.doc["extensions"]["EXT_lights_area"]["lights"] = json::array({{{"type", "rect"}, {"size", -1}}});
    builder.push("nodes", {{"extensions", {{"EXT_lights_area", {{"light", 0}}}}}});
    const SceneData scene = loaded_scene(builder.gltf());
    EXPECT_GT(scene.lights.at(0).height_m, 0.0F);
    EXPECT_LT(scene.lights.at(0).height_m, 1e-5F);
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("light.size"), std::string::npos);
}

TEST(SceneImport, LetsANodeOverrideTheShadowOfItsLightAlone) {
    GltfBuilder builder = with_lights({{{"type", "point"}, {"name", "lamp"}}});
    json second = builder.doc["nodes"][0];
    second["extras"] = {{"shadow", false}};
    builder.push("nodes", second);
    const SceneData scene = loaded_scene(builder.gltf());
    ASSERT_EQ(scene.nodes.size(), 2U);
    EXPECT_TRUE(scene.lights.at(static_cast<std::size_t>(scene.nodes[0].light)).casts_shadow);
    const auto& other = scene.lights.at(static_cast<std::size_t>(scene.nodes[1].light));
    EXPECT_FALSE(other.casts_shadow);
    EXPECT_EQ(other.name, "lamp");
}

TEST(SceneImport, AcceptsASpotOfHalfASphereWrittenAsFloat) {
    const GltfBuilder builder = with_lights({{{"type", "spot"}, {"spot", {{"outerConeAngle", double{1.57079637F}}}}}});
    EXPECT_FLOAT_EQ(loaded_scene(builder.gltf()).lights.at(0).outer_cone_rad, 1.57079637F);
}

TEST(SceneImport, ReadsCameras) {
    GltfBuilder builder;
    builder.push("cameras",
                 {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
    builder.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 50}}}});
    builder.push("cameras",
                 {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}});
    builder.push("nodes", {{"camera", 2}});
    const SceneData scene = loaded_scene(builder.gltf());
    ASSERT_EQ(scene.cameras.size(), 3U);
    EXPECT_EQ(scene.cameras[0].name, "eye");
    EXPECT_EQ(scene.cameras[0].fov_y_rad, 0.8);
    EXPECT_EQ(scene.cameras[0].near_m, 0.1);
    EXPECT_EQ(scene.cameras[0].far_m, 0.0) << "0 means infinite";
    EXPECT_EQ(scene.cameras[1].far_m, 50.0);
    EXPECT_EQ(scene.cameras[2].kind, assets::CameraKind::orthographic);
    EXPECT_EQ(scene.cameras[2].half_height_m, 3.0);
    EXPECT_EQ(scene.cameras[0].aspect, 0.0) << "none was chosen";
    EXPECT_EQ(scene.cameras[2].aspect, 2.0 / 3.0);
    EXPECT_EQ(scene.nodes.at(0).camera, 2);
}

TEST(SceneImport, ReadsTheProjectsExtras) {
    GltfBuilder builder;
    builder.push("nodes", {{"extras", {{"castShadow", false}, {"receiveShadow", false}, {"visible", false}, {"shadowCatcher", true}}}});
    builder.push(
        "nodes",
        {{"extras",
          {{"motion",
            {{"kind", "swing"}, {"axis", {0, 0, 2}}, {"amplitude", 0.5}, {"period_s", 4}, {"phase", 0.25}}}}}});
    const SceneData scene = loaded_scene(builder.gltf());
    EXPECT_FALSE(scene.nodes.at(0).casts_shadow);
    EXPECT_FALSE(scene.nodes[0].receives_shadow);
    EXPECT_FALSE(scene.nodes[0].visible);
    EXPECT_TRUE(scene.nodes[0].shadow_catcher);
    EXPECT_EQ(scene.nodes[0].motion.kind, "");
    EXPECT_TRUE(scene.nodes.at(1).casts_shadow);
    EXPECT_EQ(scene.nodes[1].motion.kind, "swing");
    EXPECT_EQ(scene.nodes[1].motion.axis, glm::dvec3(0, 0, 1));
    EXPECT_EQ(scene.nodes[1].motion.amplitude, 0.5);
    EXPECT_EQ(scene.nodes[1].motion.period_s, 4.0);
    EXPECT_EQ(scene.nodes[1].motion.phase, 0.25);
}

TEST(SceneImport, IgnoresForeignExtrasWithAWarning) {
    const json foreign[] = {{{"castShadow", 1}},
                            {{"motion", "fast"}},
                            {{"motion", {{"kind", "wobble"}}}},
                            {{"motion", {{"kind", "spin"}, {"axis", {0, 0, 0}}}}},
                            {{"motion", {{"kind", "spin"}, {"axis", "y"}}}},
                            {{"motion", {{"kind", "spin"}, {"period_s", 0}}}},
                            {{"motion", {{"kind", "spin"}, {"phase", "late"}}}}};
    for (const json& extras : foreign) {
        GltfBuilder builder;
        builder.push("nodes", {{"extras", extras}});
        const SceneData scene = loaded_scene(builder.gltf());
        EXPECT_TRUE(scene.nodes.at(0).casts_shadow) << extras;
        EXPECT_EQ(scene.nodes[0].motion.kind, "") << extras;
        EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("ignored"))) << extras;
    }
}

}  // namespace
}  // namespace gnomon::test
