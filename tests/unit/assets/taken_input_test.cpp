// Input outside the letter of glTF that has one sensible meaning. Each crafted file must load, warn of its rule at its
// place, and contain what was taken. Rules that refuse are in bad_input.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "engine/assets/gltf_limits.h"
#include "tests/unit/assets/bad_input.h"

namespace gnomon::test {
namespace {

using assets::SceneData;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

struct TakenInput {
    const char* name;
    const char* rule;
    const char* pointer;
    std::function<Bytes()> make;
    std::function<bool(const SceneData&)> holds;  // what was taken
};
inline void PrintTo(const TakenInput& input, std::ostream* out) { *out << input.name; }

bool whole(const SceneData& scene) { return scene.meshes.size() == 1 && scene.meshes[0].indices.size() == 3; }

/// The triangle's good GLB from chunks as given.
std::function<Bytes()> glb_from(std::function<std::string(std::string)> change_json, std::size_t tail = 0) {
    return [=] {
        const GltfBuilder builder = triangle();
        json doc = builder.doc;
        doc["buffers"] = json::array({{{"byteLength", builder.binary.size()}}});
        Bytes bytes = glb_of(change_json(doc.dump()), builder.binary);
        bytes.resize(bytes.size() + tail);
        return bytes;
    };
}

std::string padded(std::string text, char with) {
    while (text.size() % 4 != 0) text += with;
    return text;
}

std::vector<TakenInput> taken_file_inputs() {
    return {
        {"BytesAfterTheEnd", "glb.length", "", glb_from([](auto t) { return padded(t, ' '); }, 7), whole},
        {"ZerosAfterTheJson", "glb.json_padding", "",
         glb_from([](auto t) { return padded(t + " ", 0) + std::string(4, 0); }), whole},
        {"JsonOfOddLength", "glb.chunk_alignment", "",
         [] {
             Bytes bytes = glb_from([](auto t) { return t; })();
             std::uint32_t json_length = 0;
             std::memcpy(&json_length, bytes.data() + kGlbJsonLength, sizeof(json_length));
             bytes.insert(bytes.begin() + 20 + json_length, std::byte{' '});
             put_u32(bytes, kGlbJsonLength, json_length + 1);
             put_u32(bytes, 8, static_cast<std::uint32_t>(bytes.size()));
             return bytes;
         },
         whole},
        {"TooFewBytesForAChunk", "glb.chunk_header", "",
         [] {
             Bytes bytes = glb_from([](auto t) { return padded(t, ' '); }, 4)();
             put_u32(bytes, 8, static_cast<std::uint32_t>(bytes.size()));
             return bytes;
         },
         whole},
    };
}

std::vector<TakenInput> taken_buffer_inputs() {
    /// The triangle's three positions every `stride` bytes.
    const auto strided = [](std::size_t stride) {
        return [stride] {
            GltfBuilder builder = triangle();
            Bytes bytes(2 * stride + 12);
            for (std::size_t i = 0; i < 3; ++i) std::memcpy(&bytes[i * stride], &builder.binary[i * 12], 12);
            builder.doc["accessors"][0]["bufferView"] = builder.add_view(bytes.data(), bytes.size(), stride);
            return builder.gltf();
        };
    };
    const auto same_triangle = [](const SceneData& s) {
        return whole(s) && s.meshes[0].bounds_ms.max == glm::dvec3(1, 1, 0) &&
               s.meshes[0].bounds_ms.min == glm::dvec3(0);
    };
    const auto empty_view = [] {
        GltfBuilder builder = triangle();
        builder.push("bufferViews", {{"buffer", 0}, {"byteLength", 0}});
        return builder.gltf();
    };
    return {
        {"ViewOfNothing", "buffer_view.empty", "/bufferViews/2/byteLength", empty_view, whole},
        {"StrideNoMultipleOfFour", "buffer_view.stride", "/bufferViews/2/byteStride", strided(14), same_triangle},
        {"StrideAboveWhatGlTfAllows", "buffer_view.stride", "/bufferViews/2/byteStride", strided(300), same_triangle},
        {"NoIndices", "accessor.empty", "/accessors/1/count", spoilt([](json& d) { d["accessors"][1]["count"] = 0; }),
         [](const SceneData& s) { return s.meshes[0].indices.empty(); }},
        {"SparseCountOfZero", "accessor.sparse_empty", "/accessors/0/sparse/count",
         sparse({0}, [](json& a) { a["sparse"]["count"] = 0; }), same_triangle},
    };
}

/// The triangle with one more attribute.
template <class T>
std::function<Bytes()> with(const char* name, std::vector<T> numbers, const char* type, bool normalised = false) {
    return [=] {
        GltfBuilder builder = triangle();
        builder.doc["meshes"][0]["primitives"][0]["attributes"][name] = builder.add_accessor(numbers, type, normalised);
        return builder.gltf();
    };
}

std::vector<TakenInput> taken_mesh_inputs() {
    const char* const kPosition = "/meshes/0/primitives/0/attributes/POSITION";
    const char* const kNormal = "/meshes/0/primitives/0/attributes/NORMAL";
    const auto flat_normals = [](const SceneData& s) {
        return whole(s) && s.meshes[0].vertices[1].normal_ms == glm::vec3(0, 0, 1);
    };
    const auto two_triangles = [] {
        GltfBuilder builder = triangle();
        const std::vector<float> places{0, 0, 0, 1, 0, 0, 0, 1, 0, kNan, 0, 0, 0, -kInfinity, 0};
        json& attributes = builder.doc["meshes"][0]["primitives"][0];
        attributes["attributes"]["POSITION"] = builder.add_accessor(places, "VEC3");
        attributes["indices"] = builder.add_accessor<std::uint16_t>({0, 1, 3, 0, 1, 2, 1, 2, 4}, "SCALAR");
        return builder.gltf();
    };
    return {
        {"NormalsThatAreNoNumbers", "attribute.not_finite", kNormal,
         with<float>("NORMAL", {0, 0, 1, kNan, 0, 0, 0, kInfinity, 0}, "VEC3"), flat_normals},
        {"NormalsOfAnotherCount", "attribute.left_out", kNormal, with<float>("NORMAL", {0, 1, 0}, "VEC3"),
         flat_normals},
        {"NormalsOfAnotherType", "attribute.left_out", kNormal, with<float>("NORMAL", {0, 1, 0, 1, 0, 1}, "VEC2"),
         flat_normals},
        {"CoordinatesThatAreNoNumbers", "attribute.not_finite", "/meshes/0/primitives/0/attributes/TEXCOORD",
         with<float>("TEXCOORD_0", {kNan, 0, 1, 0, 0, 1}, "VEC2"),
         [](const SceneData& s) { return whole(s) && s.meshes[0].vertices[0].uv == glm::vec2(0.0F); }},
        {"ColoursOfPlainIntegers", "attribute.not_normalised", "/meshes/0/primitives/0/attributes/COLOR_0",
         with<std::uint8_t>("COLOR_0", {255, 0, 0, 51, 255, 0, 0, 51, 255, 0, 0, 51}, "VEC4"),
         [](const SceneData& s) { return s.meshes[0].colours.at(2) == glm::vec4(1, 0, 0, 0.2F); }},
        {"CornersThatAreNoNumbers", "position.not_finite", kPosition, two_triangles,
         [](const SceneData& s) {
             return s.meshes[0].indices == std::vector<std::uint32_t>{0, 1, 2} &&
                    s.meshes[0].submeshes.at(0).index_count == 3;
         }},
        {"FarFromTheOrigin", "position.large", "/meshes/0", positions({2e6F, 0, 0, 2e6F + 1, 0, 0, 2e6F, 1, 0}),
         [](const SceneData& s) {
             const auto& below = s.nodes.at(1);
             return below.parent == 0 && below.mesh == 0 && s.nodes[0].mesh == assets::kNone &&
                    below.translation_m.x + s.meshes[0].bounds_ms.min.x == 2e6 &&
                    below.translation_m.x + s.meshes[0].bounds_ms.max.x == 2e6 + 1 && below.scale == glm::dvec3(1);
         }},
        {"LargerThanFloatsShouldBe", "position.large", "/meshes/0", positions({-3e6F, 0, 0, 3e6F, 0, 0, 0, 0.1F, 0}),
         [](const SceneData& s) {
             const auto& below = s.nodes.at(1);
             return below.scale == glm::dvec3(4.0) && below.translation_m == glm::dvec3(0.0) &&
                    s.meshes[0].bounds_ms.max == glm::dvec3(3e6F, 0.1F, 0) / 4.0;
         }},
    };
}

glm::dmat4 placing_of(const assets::Node& node) {
    return glm::scale(glm::translate(glm::dmat4(1.0), node.translation_m) * glm::mat4_cast(node.rotation), node.scale);
}

std::vector<TakenInput> taken_node_inputs() {
    const json one = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    json rounded = one;
    rounded[15] = 0.9999999403953552;
    const auto unplaced = [](const SceneData& s) {
        return s.nodes.size() == 1 && placing_of(s.nodes[0]) == glm::dmat4(1.0);
    };
    const auto scenes = [](json list) {
        return spoilt([list](json& d) {
            d["nodes"] = json::array({{{"children", {1}}}, {{"mesh", 0}}});
            d["scenes"] = json::array({{{"nodes", list}}});
        });
    };
    const auto child = [](const SceneData& s) { return s.nodes.size() == 2 && s.nodes[1].parent == 0; };
    return {
        {"LastRowOffByRounding", "node.matrix_last_row", "/nodes/0/matrix", nodes({{{"matrix", rounded}}}), unplaced},
        {"MatrixBesideTranslation", "node.matrix_and_trs", "/nodes/0/matrix",
         nodes({{{"matrix", one}, {"translation", {5, 0, 0}}}}), unplaced},
        {"RotationOfZero", "node.rotation_zero", "/nodes/0/rotation", nodes({{{"rotation", {0, 0, 0, 0}}}}), unplaced},
        {"ShearingMatrix", "node.matrix_sheared", "/nodes/0/matrix",
         nodes({{{"matrix", {1, 0, 0, 0, 0.4, 1, 0, 0, 0, 0, 1, 0, 3, 2, 1, 1}}, {"mesh", 0}}}),
         [](const SceneData& s) { return s.nodes.size() == 2 && s.nodes[1].mesh == 0 && s.nodes[1].parent == 0; }},
        {"SceneListsANodeTwice", "scene.node_twice", "/scenes/0/nodes/1", scenes({0, 0}), child},
        {"SceneListsAParentAndItsChild", "scene.node_twice", "/scenes/0/nodes/1", scenes({0, 1}), child},
        {"SceneListsAChildAndItsParent", "scene.node_twice", "/scenes/0/nodes/0", scenes({1, 0}), child},
        {"SkinWithoutJoints", "skin.no_joints", "/skins/0/joints",
         [] {
             GltfBuilder builder = skinned_triangle();
             builder.doc["skins"][0]["joints"] = json::array();
             return builder.gltf();
         },
         [](const SceneData& s) { return s.nodes.at(0).skin == assets::kNone; }},
    };
}

std::vector<TakenInput> taken_light_inputs() {
    static const std::string spot = std::string{kLight0} + "/spot", intensity = std::string{kLight0} + "/intensity",
                             range = std::string{kLight0} + "/range", colour = std::string{kLight0} + "/color";
    const auto cone = [](double inner, double outer) {
        return light({{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}});
    };
    const auto cones = [](float inner, float outer) {
        return [=](const SceneData& s) {
            const assets::LightData& l = s.lights.at(0);
            return l.inner_cone_rad == inner && l.outer_cone_rad == outer && l.intensity == 1.0F;
        };
    };
    const auto endless = [](const SceneData& s) { return s.lights.at(0).range_m == 0.0F; };
    const auto dark = [](const SceneData& s) { return s.lights.at(0).intensity == 0.0F; };
    return {
        {"ConeWithoutAnEdge", "light.cone", spot.c_str(), cone(0.6, 0.6), cones(0.6F, 0.6F)},
        {"ConeInverted", "light.cone", spot.c_str(), cone(0.5, 0.4), cones(0.4F, 0.4F)},
        {"ConeNegative", "light.cone", spot.c_str(), cone(-0.1, 0.4), cones(0.0F, 0.4F)},
        {"ConeWiderThanAHalfSphere", "light.cone", spot.c_str(), cone(0, 1.6), cones(0.0F, 1.57079637F)},
        {"ConeOfNothing", "light.cone", spot.c_str(), cone(0, 0), dark},
        {"SpotWithoutSpot", "light.no_spot", kLight0, light({{"type", "spot"}}), cones(0.0F, 0.785398163F)},
        {"IntensityNegative", "light.intensity", intensity.c_str(), light({{"type", "point"}, {"intensity", -3}}),
         dark},
        {"RangeZero", "light.range", range.c_str(), light({{"type", "point"}, {"range", 0}}), endless},
        {"RangeNegative", "light.range", range.c_str(), light({{"type", "point"}, {"range", -2}}), endless},
        {"RangeBeyondFloat", "light.range", range.c_str(), light({{"type", "point"}, {"range", 1e39}}), endless},
        {"ColourNegative", "light.colour", colour.c_str(), light({{"type", "point"}, {"color", {1, -1, 0}}}),
         [](const SceneData& s) { return s.lights.at(0).colour == glm::vec3(1, 0, 0); }},
    };
}

/// Returns what makes a file with one light of EXT_lights_area, and a node for it.
std::function<Bytes()> area_light(const json& source, bool and_a_point = false) {
    GltfBuilder builder = triangle();
    builder.doc["extensionsUsed"] = {"EXT_lights_area", "KHR_lights_punctual"};
    builder.doc["extensions"]["EXT_lights_area"]["lights"] = json::array({source});
    builder.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    json node = {{"extensions", {{"EXT_lights_area", {{"light", 0}}}}}};
    if (and_a_point) node["extensions"]["KHR_lights_punctual"] = {{"light", 0}};
    builder.push("nodes", node);
    return [builder] { return builder.gltf(); };
}

std::vector<TakenInput> taken_area_light_inputs() {
    const auto thin = [](float assets::LightData::*side) {
        return [=](const SceneData& s) { return s.lights.at(1).*side > 0.0F && s.lights.at(1).*side < 1e-5F; };
    };
    return {
        {"AreaSizeZero", "light.size", "/extensions/EXT_lights_area/lights/0/size",
         area_light({{"type", "disk"}, {"size", 0}}), thin(&assets::LightData::radius_m)},
        {"AreaSizeNegative", "light.size", "/extensions/EXT_lights_area/lights/0/size",
         area_light({{"type", "rect"}, {"size", -3}}), thin(&assets::LightData::height_m)},
        {"AreaAspectZero", "light.aspect", "/extensions/EXT_lights_area/lights/0/aspect",
         area_light({{"type", "rect"}, {"rect", {{"aspect", 0}}}}), thin(&assets::LightData::width_m)},
        {"NodeWithTwoLights", "light.two", "/nodes/1", area_light({{"type", "sphere"}}, true),
         [](const SceneData& s) { return s.nodes.at(1).light == 0; }},
    };
}

std::vector<TakenInput> taken_camera_inputs() {
    const auto seen_by = [](json properties) {
        return spoilt([properties](json& doc) {
            doc["cameras"] = json::array({properties});
            doc["nodes"][0]["camera"] = 0;
        });
    };
    const auto none = [](const SceneData& s) { return s.cameras.empty() && s.nodes.at(0).camera == assets::kNone; };
    const auto range = [](double near_m, double far_m) {
        return [=](const SceneData& s) { return s.cameras.at(0).near_m == near_m && s.cameras[0].far_m == far_m; };
    };
    json ratio = perspective(1, 1, 2);
    ratio["perspective"]["aspectRatio"] = -1;
    return {
        {"FovZero", "camera.fov", "/cameras/0/perspective/yfov", seen_by(perspective(0, 1, 2)), none},
        {"FovOfAFullTurn", "camera.fov", "/cameras/0/perspective/yfov", seen_by(perspective(3.2, 1, 2)), none},
        {"NearZero", "camera.near", "/cameras/0/perspective/znear", seen_by(perspective(1, 0, 2)), range(0.001, 2)},
        {"NearNegative", "camera.near", "/cameras/0/perspective/znear", seen_by(perspective(1, -1, 0.5)),
         range(0.0005, 0.5)},
        {"FarBeforeNear", "camera.far", "/cameras/0/perspective/zfar", seen_by(perspective(1, 2, 1)), range(2, 0)},
        {"AspectNegative", "camera.aspect", "/cameras/0/perspective/aspectRatio", seen_by(ratio),
         [](const SceneData& s) { return s.cameras.at(0).aspect == 0.0; }},
        {"OrthographicSizeZero", "camera.size", "/cameras/0/orthographic/ymag", seen_by(orthographic(0, 0, 1)), none},
        {"OrthographicFarBeforeNear", "camera.far", "/cameras/0/orthographic/zfar", seen_by(orthographic(1, 2, 2)),
         none},
        {"OrthographicNearNegative", "camera.near", "/cameras/0/orthographic/znear", seen_by(orthographic(1, -1, 1)),
         range(-1, 1)},
    };
}

std::vector<TakenInput> taken_material_inputs() {
    const auto material = [](json properties) {
        return spoilt([properties](json& d) { d["materials"] = json::array({properties}); });
    };
    return {
        {"EmissionNegative", "material.negative", "/materials/0/emissiveFactor",
         material({{"emissiveFactor", {0, -1, 0}}}),
         [](const SceneData& s) { return s.materials.at(0).emissive == glm::vec3(0.0F); }},
        {"CutoffNegative", "material.negative", "/materials/0/alphaCutoff", material({{"alphaCutoff", -0.5}}),
         [](const SceneData& s) { return s.materials.at(0).alpha_cutoff == 0.0F; }},
        {"BlendedCaster", "material.blend", "/materials/0 'pane'", spoilt([](json& d) {
             d["materials"] = json::array({{{"name", "pane"}, {"alphaMode", "BLEND"}}});
             d["meshes"][0]["primitives"][0]["material"] = 0;
         }),
         [](const SceneData& s) { return s.materials.at(0).alpha_mode == assets::AlphaMode::blend; }},
    };
}

std::vector<TakenInput> all_taken_inputs() {
    std::vector<TakenInput> all;
    for (const auto& inputs : {taken_file_inputs(), taken_buffer_inputs(), taken_mesh_inputs(), taken_node_inputs(),
                               taken_light_inputs(), taken_area_light_inputs(), taken_camera_inputs(), taken_material_inputs()})
        all.insert(all.end(), inputs.begin(), inputs.end());
    return all;
}

class TakenInputs : public testing::TestWithParam<TakenInput> {};

TEST_P(TakenInputs, LoadWithAWarningThatNamesPlaceAndRule) {
    const TakenInput& input = GetParam();
    const Result<SceneData> result = load(input.make());
    ASSERT_TRUE(result) << to_line(result.error());
    const std::string place = input.pointer[0] == 0 ? "" : std::string(input.pointer) + ": ";
    EXPECT_THAT(result.value().warnings,
                Contains(AllOf(StartsWith(place), HasSubstr("[" + std::string(input.rule) + "]"))));
    EXPECT_TRUE(input.holds(result.value()));
}

std::string name_of_taken(const testing::TestParamInfo<TakenInput>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Crafted, TakenInputs, testing::ValuesIn(all_taken_inputs()), name_of_taken);

TEST(TakenInputControl, TheUnspoiltTriangleWarnsOfNothing) {
    const auto good = load(triangle().glb(), "good.glb");
    ASSERT_TRUE(good);
    EXPECT_THAT(good.value().warnings, testing::IsEmpty());
}

TEST(TakenInputControl, WarningsAreBoundedAndCounted) {
    GltfBuilder builder = triangle();
    constexpr std::size_t kLights = 3000;
    json lights = json::array();
    for (std::size_t i = 0; i < kLights; ++i) lights.push_back({{"type", "point"}, {"range", 0}});
    builder.doc["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    const auto result = load(builder.gltf());
    ASSERT_TRUE(result) << to_line(result.error());
    ASSERT_EQ(result.value().warnings.size(), assets::gltf::kMaxWarnings + 1);
    EXPECT_EQ(result.value().warnings.back(), std::to_string(kLights - assets::gltf::kMaxWarnings) + " more warnings");
}

TEST(TakenInputControl, AnyAffineMatrixIsPlacedAsItIs) {
    const json matrices[] = {{1, 0, 0, 0, 0.4, 1, 0, 0, 0, 0, 1, 0, 3, 2, 1, 1},
                             {1, 0.5, -2, 0, 3, 1, 0.25, 0, -1, 7, 1, 0, 0, 0, 0, 1},
                             {-1, 0.5, 2, 0, 3, 1, 0.25, 0, -1, 7, 1, 0, 1e6, 0, 0, 1},
                             {1, 1, 0, 0, 1, 1.000001, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                             {1, 0, 0, 0, 1, 1, 0, 0, 1, 2, 0, 0, 0, 0, 0, 1},
                             {1e-5, 2e-5, 0, 0, 0, 1e5, 3e4, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    for (const json& matrix : matrices) {
        const auto result = load(nodes({{{"matrix", matrix}}})());
        ASSERT_TRUE(result) << to_line(result.error());
        const std::vector<assets::Node>& nodes = result.value().nodes;
        ASSERT_EQ(nodes.size(), 2U) << matrix;
        const glm::dmat4 both = placing_of(nodes[0]) * placing_of(nodes[1]);
        double largest = 0.0;
        for (int i = 0; i < 12; ++i)
            largest = std::max(largest, std::abs(matrix[static_cast<std::size_t>(i)].get<double>()));
        for (int i = 0; i < 16; ++i)
            EXPECT_NEAR(both[i / 4][i % 4], matrix[static_cast<std::size_t>(i)].get<double>(), 1e-12 * largest)
                << matrix << ", element " << i;
    }
}

}  // namespace
}  // namespace gnomon::test
