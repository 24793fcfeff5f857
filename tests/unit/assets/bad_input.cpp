#include "tests/unit/assets/bad_input.h"

#include <string>
#include <vector>

#include "engine/assets/gltf_limits.h"

namespace gnomon::test {
namespace {

namespace limits = assets::gltf;

std::vector<BadInput> framing_inputs() {
    return {
        {"EmptyFile", "json.syntax", "", text("")},
        {"NoJson", "json.syntax", "", text("this is no glTF")},
        {"TruncatedJson", "json.syntax", "", text(R"({"asset":{"version":"2.0")")},
        {"TrailingText", "json.syntax", "", text(R"({"asset":{"version":"2.0"}} more)")},
        {"InvalidUtf8", "json.syntax", "", text("{\"asset\":{\"version\":\"2.0\",\"generator\":\"\xC3\x28\"}}")},
        {"NanInJson", "json.syntax", "", text(R"({"asset":{"version":"2.0"},"nodes":[{"scale":[NaN,1,1]}]})")},
        {"NumberBeyondDouble", "json.number_range", "", text(R"({"asset":{"version":"2.0"},"scene":1e999})")},
        {"RootIsAnArray", "json.root", "", text("[]")},
        {"NestedTooDeep", "json.depth", "",
         text(R"({"asset":{"version":"2.0"},"extras":)" + repeated("[", 100'000) + repeated("]", 100'000) + "}")},
        {"TooManyValues", "json.too_many_values", "",
         text(R"({"asset":{"version":"2.0"},"extras":[0)" + repeated(",0", limits::kMaxJsonValues) + "]}")},
        {"WrongMagic", "glb.magic", "", spoilt_glb([](Bytes& b) { b[0] = std::byte{'x'}; }), "bad.glb"},
        {"HeaderCutShort", "glb.truncated", "", spoilt_glb([](Bytes& b) { b.resize(15); })},
        {"BodyCutShort", "glb.truncated", "", spoilt_glb([](Bytes& b) { b.resize(b.size() - 8); })},
        {"GlbVersion1", "glb.version", "", spoilt_glb([](Bytes& b) { put_u32(b, 4, 1); })},
        {"ChunkTooLong", "glb.chunk_length", "", spoilt_glb([](Bytes& b) { put_u32(b, kGlbJsonLength, 0xFFFFFFF0U); })},
        {"BinChunkTooLong", "glb.chunk_length", "", spoilt_glb([](Bytes& b) { put_u32(b, bin_chunk_at(b), 0x1000); })},
        {"FirstChunkIsNotJson", "glb.first_chunk", "", spoilt_glb([](Bytes& b) { put_u32(b, 16, 0x004E4942); })},
        {"TwoJsonChunks", "glb.duplicate_chunk", "",
         spoilt_glb([](Bytes& b) { put_u32(b, bin_chunk_at(b) + 4, 0x4E4F534A); })},
    };
}

std::vector<BadInput> shape_inputs() {
    return {
        {"NoAsset", "property.missing", "", spoilt([](json& d) { d.erase("asset"); })},
        {"NoVersion", "property.missing", "/asset", spoilt([](json& d) { d["asset"].erase("version"); })},
        {"Version1", "asset.version", "/asset/version", spoilt([](json& d) { d["asset"]["version"] = "1.0"; })},
        {"MinVersion3", "asset.min_version", "/asset/minVersion",
         spoilt([](json& d) { d["asset"]["minVersion"] = "3.0"; })},
        {"UnknownRequiredExtension", "extension.unsupported", "/extensionsRequired/0",
         spoilt([](json& d) { d["extensionsRequired"] = {"EXT_magic"}; })},
        {"NodesIsAnObject", "property.type", "/nodes", spoilt([](json& d) { d["nodes"] = json::object(); })},
        {"NodeIsANumber", "property.type", "/nodes/0", nodes({7})},
        {"NameIsANumber", "property.type", "/nodes/0/name", nodes({{{"name", 7}}})},
        {"ScaleOfTwo", "property.length", "/nodes/0/scale", nodes({{{"scale", {1, 2}}}})},
        {"ScaleOfWords", "property.type", "/nodes/0/scale", nodes({{{"scale", {"a", "b", "c"}}}})},
        {"FractionalIndex", "property.type", "/nodes/0/mesh", nodes({{{"mesh", 0.5}}})},
        {"NegativeMesh", "reference.unresolved", "/nodes/0/mesh", nodes({{{"mesh", -1}}})},
        {"UnknownMesh", "reference.unresolved", "/nodes/0/mesh", nodes({{{"mesh", 1}}})},
        {"UnknownCamera", "reference.unresolved", "/nodes/0/camera", nodes({{{"camera", 0}}})},
        {"UnknownLight", "reference.unresolved", "/nodes/0/extensions/KHR_lights_punctual/light",
         nodes({{{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}})},
        {"UnknownChild", "reference.unresolved", "/nodes/0/children/0", nodes({{{"children", {9}}}})},
        {"UnknownScene", "reference.unresolved", "/scene", spoilt([](json& d) { d["scene"] = 0; })},
        {"UnknownSceneNode", "reference.unresolved", "/scenes/0/nodes/0", spoilt([](json& d) {
             d["scenes"] = {{{"nodes", {1e300}}}};
         })},
        {"UnknownMaterial", "reference.unresolved", "/meshes/0/primitives/0/material",
         spoilt([](json& d) { d["meshes"][0]["primitives"][0]["material"] = 0; })},
        {"UnknownPosition", "reference.unresolved", "/meshes/0/primitives/0/attributes/POSITION",
         spoilt([](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99; })},
        {"UnknownIndices", "reference.unresolved", "/meshes/0/primitives/0/indices",
         spoilt([](json& d) { d["meshes"][0]["primitives"][0]["indices"] = std::uint64_t{1} << 40; })},
        {"UnknownBuffer", "reference.unresolved", "/bufferViews/0/buffer",
         spoilt([](json& d) { d["bufferViews"][0]["buffer"] = 1; })},
        {"UnknownBufferView", "reference.unresolved", "/accessors/0/bufferView",
         spoilt([](json& d) { d["accessors"][0]["bufferView"] = 2; })},
        {"UnknownTexture", "reference.unresolved", "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
         spoilt([](json& d) {
             d["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
         })},
        {"UnknownImage", "reference.unresolved", "/textures/0/source", spoilt([](json& d) {
             d["textures"] = json::array({{{"source", 3}}});
         })},
        {"NegativeOffset", "property.range", "/accessors/0/byteOffset",
         spoilt([](json& d) { d["accessors"][0]["byteOffset"] = -4; })},
        {"UnknownAccessorType", "property.choice", "/accessors/0/type",
         spoilt([](json& d) { d["accessors"][0]["type"] = "VEC9"; })},
        {"UnknownAlphaMode", "property.choice", "/materials/0/alphaMode", spoilt([](json& d) {
             d["materials"] = json::array({{{"alphaMode", "GLOW"}}});
         })},
        {"TooManyNodes", "collection.too_large", "/nodes",
         spoilt([](json& d) { d["nodes"] = json(limits::kMaxNodes + 1, json::object()); })},
    };
}

std::vector<BadInput> buffer_inputs() {
    return {
        {"BufferTooShort", "buffer.too_short", "/buffers/0/byteLength", spoilt([](json& d) {
             d["buffers"] = {{{"byteLength", 42}, {"uri", "data:;base64,AAAA"}}};
         })},
        {"BufferWithoutData", "buffer.no_data", "/accessors/0", spoilt([](json& d) {
             d["buffers"] = json::array({{{"byteLength", 42}}});
         })},
        {"EmptyGlbBuffer", "buffer_view.out_of_range", "/bufferViews/0",
         [] {
             GltfBuilder builder = triangle();
             builder.doc["buffers"] = json::array({{{"byteLength", 0}}});
             return builder.glb();
         }},
        {"GlbBufferLongerThanItsChunk", "buffer.too_short", "/buffers/0/byteLength",
         [] {
             GltfBuilder builder = triangle();
             builder.doc["buffers"] = json::array({{{"byteLength", builder.binary.size() + 100}}});
             return builder.glb();
         }},
        {"ViewPastItsBuffer", "buffer_view.out_of_range", "/bufferViews/1",
         spoilt([](json& d) { d["bufferViews"][1]["byteLength"] = 1000; })},
        {"ViewOffsetOverflows", "buffer_view.out_of_range", "/bufferViews/0",
         spoilt([](json& d) { d["bufferViews"][0]["byteOffset"] = (std::uint64_t{1} << 53); })},
        {"ElementsOverlap", "accessor.stride", "/accessors/0",
         spoilt([](json& d) { d["bufferViews"][0]["byteStride"] = 8; })},
        {"AccessorPastItsView", "accessor.out_of_range", "/accessors/0",
         spoilt([](json& d) { d["accessors"][0]["count"] = 4; })},
        {"AccessorOffsetPastItsView", "accessor.out_of_range", "/accessors/0",
         spoilt([](json& d) { d["accessors"][0]["byteOffset"] = 1; })},
        {"CountOverflows", "accessor.too_large", "/accessors/0/count",
         spoilt([](json& d) { d["accessors"][0]["count"] = std::uint64_t{1} << 40; })},
        {"HugeAccessorWithoutView", "accessor.too_large", "/accessors/0/count", spoilt([](json& d) {
             d["accessors"][0].erase("bufferView");
             d["accessors"][0]["count"] = std::uint64_t{1} << 50;
         })},
        {"MillionsOfElementsWithoutAView", "accessor.unbacked", "/accessors/0/count", spoilt([](json& d) {
             d["accessors"][0].erase("bufferView");
             d["accessors"][0]["count"] = 8'000'000;
         })},
        {"UnknownComponentType", "accessor.component_type", "/accessors/0/componentType",
         spoilt([](json& d) { d["accessors"][0]["componentType"] = 5124; })},
        {"ComponentTypeFarOff", "accessor.component_type", "/accessors/1/componentType",
         spoilt([](json& d) { d["accessors"][1]["componentType"] = 0; })},
        {"SparseCountAboveCount", "accessor.sparse_count", "/accessors/0/sparse/count",
         sparse({0, 1, 2, 3}, [](json&) {})},
        {"SparseIndicesOfFloats", "accessor.sparse_index_type", "/accessors/0/sparse/indices/componentType",
         sparse({0}, [](json& a) { a["sparse"]["indices"]["componentType"] = kFloat; })},
        {"SparseIndicesPastTheirView", "accessor.sparse_out_of_range", "/accessors/0/sparse/indices",
         sparse({0}, [](json& a) { a["sparse"]["indices"]["byteOffset"] = 1; })},
        {"SparseValuesPastTheirView", "accessor.sparse_out_of_range", "/accessors/0/sparse/values",
         sparse({0}, [](json& a) { a["sparse"]["values"]["byteOffset"] = 4; })},
        {"SparseIndexAboveCount", "accessor.sparse_index", "/accessors/0/sparse/indices", sparse({3}, [](json&) {})},
        {"SparseIndicesNotRising", "accessor.sparse_index", "/accessors/0/sparse/indices",
         sparse({1, 1}, [](json&) {})},
        {"SparseWithoutValues", "property.missing", "/accessors/0/sparse",
         sparse({0}, [](json& a) { a["sparse"].erase("values"); })},
    };
}

std::vector<BadInput> mesh_inputs() {
    const char* const kPosition = "/meshes/0/primitives/0/attributes/POSITION";
    const char* const kIndices = "/meshes/0/primitives/0/indices";
    return {
        {"FarAwayMeshThatBends", "position.too_large", "/meshes/0",
         [] {
             GltfBuilder builder = triangle();
             builder.doc["accessors"][0]["bufferView"] =
                 builder.add_view(std::vector<float>{2e6F, 0, 0, 3e6F, 0, 0, 2e6F, 1, 0}.data(), 9 * sizeof(float));
             builder.doc["meshes"][0]["primitives"][0]["targets"] = json::array({{{"POSITION", 0}}});
             return builder.gltf();
         }},
        {"NoPosition", "primitive.no_position", "/meshes/0/primitives/0/attributes",
         spoilt([](json& d) { d["meshes"][0]["primitives"][0]["attributes"] = json::object(); })},
        {"ModeSeven", "primitive.mode", "/meshes/0/primitives/0/mode",
         spoilt([](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 7; })},
        {"IndexPastTheVertices", "index.out_of_range", kIndices, indices<std::uint16_t>({0, 1, 3})},
        {"IndexFarPastTheVertices", "index.out_of_range", kIndices, indices<std::uint32_t>({0, 1, 0xFFFFFFFEU})},
        {"RestartByte", "index.restart", "/accessors/2", indices<std::uint8_t>({0, 1, 255})},
        {"RestartShort", "index.restart", "/accessors/2", indices<std::uint16_t>({0, 1, 65535})},
        {"RestartInt", "index.restart", "/accessors/2", indices<std::uint32_t>({0, 1, 0xFFFFFFFFU})},
        {"IndicesOfFloats", "index.type", "/accessors/2", indices<float>({0, 1, 2})},
        {"IndicesOfSignedBytes", "index.type", "/accessors/2", indices<std::int8_t>({0, 1, 2})},
        {"IndicesOfVectors", "index.type", "/accessors/0",
         spoilt([](json& d) { d["meshes"][0]["primitives"][0]["indices"] = 0; })},
        {"PositionOfShorts", "attribute.type", kPosition,
         spoilt([](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 1; })},
        {"TooManyVertices", "total.decoded_bytes", kPosition,
         [] {
             GltfBuilder builder = triangle();
             const std::size_t count = limits::kMaxDecodedBytes / sizeof(assets::Vertex) + 1;
             const Bytes positions(4 * count);  // three bytes each and one of padding
             builder.doc["extensionsUsed"] = {"KHR_mesh_quantization"};
             builder.doc["accessors"][0] = {{"bufferView", builder.add_view(positions.data(), positions.size(), 4)},
                                            {"componentType", kByte},
                                            {"count", count},
                                            {"type", "VEC3"}};
             return builder.glb();
         }},
        {"TooManyTrianglesInOnePrimitive", "total.triangles", "/meshes/0/primitives/0",
         [] {
             GltfBuilder builder = triangle();
             const std::vector<std::uint8_t> zeros(3 * (limits::kMaxTriangles + 1));
             builder.doc["meshes"][0]["primitives"][0]["indices"] = builder.add_accessor(zeros, "SCALAR");
             return builder.glb();
         }},
        {"TooManyTriangles", "total.triangles", "/meshes/0/primitives/1",
         [] {
             GltfBuilder builder = triangle();
             const std::vector<std::uint8_t> zeros(30'000'000);
             const int many = builder.add_accessor(zeros, "SCALAR");
             json& primitives = builder.doc["meshes"][0]["primitives"];
             primitives[0]["indices"] = many;
             primitives.push_back(primitives[0]);
             return builder.glb();
         }},
    };
}

std::vector<BadInput> node_inputs() {
    return {
        {"NodeIsItsOwnChild", "node.cycle", "/nodes/0", nodes({{{"children", {0}}}})},
        {"NodeCycle", "node.cycle", "/nodes/0", nodes({{{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}})},
        {"SecondParent", "node.second_parent", "/nodes/1/children/0",
         nodes({{{"children", {2}}}, {{"children", {2}}}, json::object()})},
        {"ChildListedTwice", "node.second_parent", "/nodes/0/children/1",
         nodes({{{"children", {1, 1}}}, json::object()})},
        {"ChainTooDeep", "node.too_deep", "/nodes/256", nodes(chain(limits::kMaxNodeDepth + 1))},
        {"ChainMuchTooDeep", "node.too_deep", "/nodes/256", nodes(chain(100'000))},
        {"ProjectiveMatrix", "node.matrix_not_affine", "/nodes/0/matrix",
         nodes({{{"matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}})},
        {"MatrixOverflows", "node.not_finite", "/nodes/0/matrix",
         nodes({{{"matrix", {1e300, 0, 0, 0, 0, 1e300, 0, 0, 0, 0, 1e300, 0, 0, 0, 0, 1}}}})},
        {"RotationOverflows", "node.rotation", "/nodes/0/rotation", nodes({{{"rotation", {1e200, 0, 0, 0}}}})},
        {"OutOfTheWorld", "node.out_of_world", "/nodes/0", nodes({{{"translation", {2e10, 0, 0}}}})},
        {"ScaledOutOfTheWorld", "node.out_of_world", "/nodes/0", nodes({{{"mesh", 0}, {"scale", {1e11, 1, 1}}}})},
        {"ScalesMultiplyBeyondAllNumbers", "node.not_finite", "/nodes/1",
         nodes({{{"scale", {1e200, 1, 1}}, {"children", {1}}}, {{"scale", {1e200, 1, 1}}}})},
    };
}

std::vector<BadInput> light_and_camera_inputs() {
    static const std::string type = std::string{kLight0} + "/type", intensity = std::string{kLight0} + "/intensity",
                             colour = std::string{kLight0} + "/color";
    return {
        {"UnknownLightType", "property.choice", type.c_str(), light({{"type", "area"}})},
        {"IntensityBeyondFloat", "light.intensity", intensity.c_str(), light({{"type", "point"}, {"intensity", 1e39}})},
        {"IntensityBelowFloat", "light.intensity", intensity.c_str(),
         light({{"type", "point"}, {"intensity", -1e308}})},
        {"ColourBeyondFloat", "light.colour", colour.c_str(), light({{"type", "point"}, {"color", {1, 1e39, 0}}})},
        {"UnknownCameraType", "property.choice", "/cameras/0/type", camera({{"type", "fisheye"}})},
        {"CameraWithoutLens", "property.missing", "/cameras/0", camera({{"type", "perspective"}})},
        {"EmissionBeyondFloat", "material.range", "/materials/0/emissiveFactor", spoilt([](json& d) {
             d["materials"] = json::array({{{"emissiveFactor", {0, 1e300, 0}}}});
         })},
    };
}

}  // namespace

std::vector<BadInput> all_bad_inputs() {
    std::vector<BadInput> all;
    for (const auto& inputs : {framing_inputs(), shape_inputs(), buffer_inputs(), mesh_inputs(), node_inputs(),
                               light_and_camera_inputs(), skin_and_animation_inputs()}) {
        all.insert(all.end(), inputs.begin(), inputs.end());
    }
    return all;
}

}  // namespace gnomon::test
