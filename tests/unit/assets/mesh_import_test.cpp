#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/assets/gltf_builder.h"

namespace gnomon::test {
namespace {

using assets::kNone;
using assets::SceneData;
using testing::ElementsAre;

SceneData loaded_mesh(const Bytes& bytes) {
    Result<SceneData> result = load(bytes);
    EXPECT_TRUE(result) << to_line(result.error());
    return result ? std::move(result).value() : SceneData{};
}

const std::vector<float> kQuad = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

TEST(MeshImport, LoadsATriangleFromGltfAndFromGlbAlike) {
    const SceneData text = loaded_mesh(triangle().gltf());
    const SceneData binary = loaded_mesh(triangle().glb());
    for (const SceneData* scene : {&text, &binary}) {
        ASSERT_EQ(scene->meshes.size(), 1U);
        const assets::Mesh& mesh = scene->meshes[0];
        EXPECT_THAT(mesh.indices, ElementsAre(0U, 1U, 2U));
        ASSERT_EQ(mesh.vertices.size(), 3U);
        EXPECT_EQ(mesh.vertices[1].position_ms, glm::vec3(1, 0, 0));
        EXPECT_EQ(mesh.vertices[1].normal_ms, glm::vec3(0, 0, 1));
        EXPECT_EQ(mesh.bounds_ms.min, glm::dvec3(0, 0, 0));
        EXPECT_EQ(mesh.bounds_ms.max, glm::dvec3(1, 1, 0));
        EXPECT_EQ(mesh.topology.boundary_edges, 3U);
        ASSERT_EQ(mesh.submeshes.size(), 1U);
        EXPECT_EQ(mesh.submeshes[0].index_count, 3U);
        EXPECT_EQ(mesh.submeshes[0].material, 0U);
        EXPECT_EQ(scene->materials.size(), 1U);
        EXPECT_THAT(scene->warnings, testing::IsEmpty());
    }
}

template <class Index>
std::vector<std::uint32_t> indices_through() {
    GltfBuilder builder;
    const int position = builder.add_accessor<float>(kQuad, "VEC3");
    const int indices = builder.add_accessor<Index>({0, 1, 2, 2, 1, 3}, "SCALAR");
    builder.add_mesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
    return loaded_mesh(builder.gltf()).meshes.at(0).indices;
}

TEST(MeshImport, ReadsIndicesOfEveryWidth) {
    EXPECT_THAT(indices_through<std::uint8_t>(), ElementsAre(0U, 1U, 2U, 2U, 1U, 3U));
    EXPECT_THAT(indices_through<std::uint16_t>(), ElementsAre(0U, 1U, 2U, 2U, 1U, 3U));
    EXPECT_THAT(indices_through<std::uint32_t>(), ElementsAre(0U, 1U, 2U, 2U, 1U, 3U));
}

std::vector<std::uint32_t> triangles_of_mode(int mode, const std::vector<std::uint8_t>& corners) {
    GltfBuilder builder;
    const int position = builder.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 0, 0}, "VEC3");
    json primitive = {{"attributes", {{"POSITION", position}}}, {"mode", mode}};
    if (!corners.empty()) primitive["indices"] = builder.add_accessor<std::uint8_t>(corners, "SCALAR");
    builder.add_mesh(primitive);
    return loaded_mesh(builder.gltf()).meshes.at(0).indices;
}

TEST(MeshImport, TurnsStripsIntoTrianglesOfOneWinding) {
    EXPECT_THAT(triangles_of_mode(5, {4, 3, 2, 1}), ElementsAre(4U, 3U, 2U, 3U, 1U, 2U));
    EXPECT_THAT(triangles_of_mode(5, {}), ElementsAre(0U, 1U, 2U, 1U, 3U, 2U, 2U, 3U, 4U));
}

TEST(MeshImport, TurnsFansIntoTriangles) {
    EXPECT_THAT(triangles_of_mode(6, {4, 0, 1, 2}), ElementsAre(0U, 1U, 4U, 1U, 2U, 4U));
}

TEST(MeshImport, ReadsPrimitivesWithoutIndicesAndDropsAnIncompleteTriangle) {
    EXPECT_THAT(triangles_of_mode(4, {}), ElementsAre(0U, 1U, 2U));
}

TEST(MeshImport, LeavesOutPointsAndLinesWithAWarning) {
    GltfBuilder builder = triangle();
    for (const int mode : {0, 1, 2, 3}) {
        builder.doc["meshes"][0]["primitives"][0]["mode"] = mode;
        const SceneData scene = loaded_mesh(builder.gltf());
        EXPECT_THAT(scene.meshes.at(0).indices, testing::IsEmpty());
        EXPECT_THAT(scene.warnings, ElementsAre(testing::HasSubstr("points and lines")));
    }
}

TEST(MeshImport, ReadsIndicesWithoutABufferViewAsZero) {
    GltfBuilder builder = triangle();
    builder.doc["accessors"][1].erase("bufferView");
    EXPECT_THAT(loaded_mesh(builder.gltf()).meshes.at(0).indices, ElementsAre(0U, 0U, 0U));
}

TEST(MeshImport, ReadsInterleavedAttributesByTheirStride) {
    GltfBuilder builder;
    const std::vector<float> both = {0, 0, 0, 0, 0, 2, 1, 0, 0, 0, 0, 2, 0, 1, 0, 0, 0, 2};
    const int view = builder.add_view(both.data(), both.size() * sizeof(float), 24);
    const json accessor = {{"bufferView", view}, {"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}};
    const int position = builder.push("accessors", accessor);
    json shifted = accessor;
    shifted["byteOffset"] = 12;
    const int normal = builder.push("accessors", shifted);
    builder.add_mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
    const SceneData scene = loaded_mesh(builder.gltf());
    EXPECT_EQ(scene.meshes.at(0).vertices.at(2).position_ms, glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.meshes.at(0).vertices.at(2).normal_ms, glm::vec3(0, 0, 1)) << "normals come out with unit length";
}

TEST(MeshImport, FillsOnlyTheNormalsThatAreMissingOrZero) {
    GltfBuilder builder = triangle();
    const int normal = builder.add_accessor<float>({1, 0, 0, 0, 0, 0, 0, 1, 0}, "VEC3");
    builder.doc["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normal;
    const auto mesh = loaded_mesh(builder.gltf()).meshes.at(0);
    EXPECT_EQ(mesh.vertices.at(0).normal_ms, glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.vertices.at(1).normal_ms, glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.vertices.at(2).normal_ms, glm::vec3(0, 1, 0));
}

template <class T>
glm::vec2 second_uv(const std::vector<T>& numbers, bool normalized) {
    GltfBuilder builder = triangle();
    const int uv = builder.add_accessor<T>(numbers, "VEC2", normalized);
    builder.doc["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uv;
    return loaded_mesh(builder.gltf()).meshes.at(0).vertices.at(1).uv;
}

TEST(MeshImport, ReadsTextureCoordinatesOfEveryType) {
    EXPECT_EQ(second_uv<float>({0, 0, 0.25F, -3, 0, 0}, false), glm::vec2(0.25F, -3.0F));
    EXPECT_EQ(second_uv<std::uint8_t>({0, 0, 255, 51, 0, 0}, true), glm::vec2(1.0F, 0.2F));
    EXPECT_EQ(second_uv<std::uint16_t>({0, 0, 65535, 13107, 0, 0}, true), glm::vec2(1.0F, 0.2F));
}

template <class T>
assets::Vertex quantized_vertex(T value, bool normalized) {
    GltfBuilder builder;
    builder.doc["extensionsUsed"] = builder.doc["extensionsRequired"] = {"KHR_mesh_quantization"};
    const std::vector<T> numbers = {0, 0, 0, value, 0, 0, 0, value, 0};
    const int position = builder.add_accessor<T>(numbers, "VEC3", normalized);
    // Elements of three bytes or shorts are tightly packed here, which the specification discourages but allows to
    // read.
    builder.add_mesh({{"attributes", {{"POSITION", position}}}});
    return loaded_mesh(builder.gltf()).meshes.at(0).vertices.at(1);
}

TEST(MeshImport, ReadsQuantizedPositions) {
    EXPECT_EQ(quantized_vertex<std::int8_t>(-7, false).position_ms.x, -7.0F);
    EXPECT_EQ(quantized_vertex<std::int8_t>(-128, true).position_ms.x, -1.0F);
    EXPECT_EQ(quantized_vertex<std::uint8_t>(200, false).position_ms.x, 200.0F);
    EXPECT_EQ(quantized_vertex<std::int16_t>(-32767, true).position_ms.x, -1.0F);
    EXPECT_EQ(quantized_vertex<std::uint16_t>(65535, true).position_ms.x, 1.0F);
}

TEST(MeshImport, PutsSparseValuesOverTheBase) {
    GltfBuilder builder = triangle();
    const std::vector<std::uint8_t> which = {2};
    const std::vector<float> values = {0, 5, 0};
    const int indices = builder.add_view(which.data(), which.size());
    const int numbers = builder.add_view(values.data(), values.size() * sizeof(float));
    builder.doc["accessors"][0]["sparse"] = {{"count", 1},
                                             {"indices", {{"bufferView", indices}, {"componentType", kUByte}}},
                                             {"values", {{"bufferView", numbers}}}};
    const auto mesh = loaded_mesh(builder.gltf()).meshes.at(0);
    EXPECT_EQ(mesh.vertices.at(1).position_ms, glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.vertices.at(2).position_ms, glm::vec3(0, 5, 0));
}

TEST(MeshImport, StartsASparseAccessorWithoutABufferViewAtZero) {
    GltfBuilder builder = triangle();
    const std::vector<std::uint16_t> which = {1, 2};
    const std::vector<float> values = {4, 0, 0, 0, 5, 0};
    const int indices = builder.add_view(which.data(), which.size() * 2);
    const int numbers = builder.add_view(values.data(), values.size() * sizeof(float));
    builder.doc["accessors"][0].erase("bufferView");
    builder.doc["accessors"][0]["sparse"] = {{"count", 2},
                                             {"indices", {{"bufferView", indices}, {"componentType", kUShort}}},
                                             {"values", {{"bufferView", numbers}}}};
    const auto mesh = loaded_mesh(builder.gltf()).meshes.at(0);
    EXPECT_EQ(mesh.vertices.at(0).position_ms, glm::vec3(0));
    EXPECT_EQ(mesh.vertices.at(1).position_ms, glm::vec3(4, 0, 0));
    EXPECT_EQ(mesh.vertices.at(2).position_ms, glm::vec3(0, 5, 0));
}

TEST(MeshImport, MakesOneSubmeshPerPrimitiveAndSharesVerticesOfTheSameAccessors) {
    GltfBuilder builder = triangle();
    json& primitives = builder.doc["meshes"][0]["primitives"];
    builder.push("materials", {{"name", "red"}});
    json second = primitives[0];
    second["material"] = 0;
    primitives.push_back(second);
    const SceneData scene = loaded_mesh(builder.gltf());
    const auto& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.vertices.size(), 3U);
    ASSERT_EQ(mesh.submeshes.size(), 2U);
    EXPECT_EQ(mesh.submeshes[1].first_index, 3U);
    EXPECT_EQ(mesh.submeshes[0].material, 1U) << "the default material stands behind the file's";
    EXPECT_EQ(mesh.submeshes[1].material, 0U);
    EXPECT_EQ(scene.materials.size(), 2U);
}

TEST(MeshImport, RecomputesBoundsFromTheVerticesThatTrianglesUse) {
    GltfBuilder builder;
    const int position = builder.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 99, 99, 99}, "VEC3");
    builder.doc["accessors"][position]["max"] = {1e9, 1e9, 1e9};
    const int indices = builder.add_accessor<std::uint8_t>({0, 1, 2}, "SCALAR");
    builder.add_mesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}});
    EXPECT_EQ(loaded_mesh(builder.gltf()).meshes.at(0).bounds_ms.max, glm::dvec3(1, 1, 0));
}

TEST(MeshImport, AcceptsWholeNumbersWrittenWithAFraction) {
    GltfBuilder builder = triangle();
    builder.doc["accessors"][1]["count"] = 3.0;
    builder.doc["nodes"][0]["mesh"] = 0.0;
    EXPECT_EQ(loaded_mesh(builder.gltf()).nodes.at(0).mesh, 0);
}

}  // namespace
}  // namespace gnomon::test
