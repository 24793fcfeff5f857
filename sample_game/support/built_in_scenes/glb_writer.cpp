#include "sample_game/support/built_in_scenes/glb_writer.h"

#include <array>
#include <cstring>
#include <glm/common.hpp>
#include <limits>

namespace gnomon::game {
namespace {

// Constants of the glTF 2.0 specification.
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kLinear = 9729, kLinearMipmapLinear = 9987;
constexpr std::uint32_t kMagic = 0x46546C67u, kVersion = 2u, kJsonChunk = 0x4E4F534Au, kBinaryChunk = 0x004E4942u;
constexpr std::size_t kAlignment = 4, kHeaderBytes = 12, kChunkHeaderBytes = 8;

void pad(std::vector<std::byte>& bytes, std::byte with) {
    while (bytes.size() % kAlignment != 0) bytes.push_back(with);
}

void put_u32(std::vector<std::byte>& bytes, std::uint32_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(value >> shift & 0xffu));
}

void put_chunk(std::vector<std::byte>& bytes, std::uint32_t type, const std::vector<std::byte>& content) {
    put_u32(bytes, static_cast<std::uint32_t>(content.size()));
    put_u32(bytes, type);
    bytes.insert(bytes.end(), content.begin(), content.end());
}

template <class V>
nlohmann::ordered_json to_array(const V& vector) {
    nlohmann::ordered_json array = nlohmann::ordered_json::array();
    for (glm::length_t i = 0; i < V::length(); ++i) array.push_back(vector[i]);
    return array;
}

}  // namespace

std::uint32_t GlbBuilder::add_view(std::span<const std::byte> bytes, std::optional<int> target) {
    pad(binary_, std::byte{0});
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (target) view["target"] = *target;
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    views_.push_back(std::move(view));
    return static_cast<std::uint32_t>(views_.size()) - 1u;
}

std::uint32_t GlbBuilder::add_accessor(Json accessor) {
    accessors_.push_back(std::move(accessor));
    return static_cast<std::uint32_t>(accessors_.size()) - 1u;
}

std::uint32_t GlbBuilder::add_texture(const std::string& name, std::span<const std::uint8_t> png) {
    const std::uint32_t view = add_view(std::as_bytes(png), std::nullopt);
    images_.push_back({{"name", name}, {"bufferView", view}, {"mimeType", "image/png"}});
    textures_.push_back({{"name", name}, {"sampler", 0}, {"source", images_.size() - 1}});
    return static_cast<std::uint32_t>(textures_.size()) - 1u;
}

std::uint32_t GlbBuilder::add_material(const MaterialSpec& spec) {
    Json pbr = {{"baseColorFactor", to_array(spec.base_colour)},
                {"metallicFactor", spec.metallic},
                {"roughnessFactor", spec.roughness}};
    if (spec.texture) pbr["baseColorTexture"] = {{"index", *spec.texture}};
    Json material = {{"name", spec.name}, {"pbrMetallicRoughness", std::move(pbr)}};
    if (spec.emissive != glm::vec3(0.0f)) material["emissiveFactor"] = to_array(spec.emissive);
    if (spec.alpha_cutoff) {
        material["alphaMode"] = "MASK";
        material["alphaCutoff"] = *spec.alpha_cutoff;
    }
    if (spec.double_sided) material["doubleSided"] = true;
    materials_.push_back(std::move(material));
    return static_cast<std::uint32_t>(materials_.size()) - 1u;
}

GlbBuilder::Json GlbBuilder::primitive(const PartSpec& part) {
    const Shape& shape = part.shape;
    glm::vec3 min(std::numeric_limits<float>::infinity()), max(-min);
    for (const glm::vec3& p : shape.positions) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    const std::size_t count = shape.positions.size();
    const auto vertex_accessor = [&](std::uint32_t view, const char* type) {
        return Json{{"bufferView", view}, {"componentType", kFloat}, {"count", count}, {"type", type}};
    };
    Json positions = vertex_accessor(add_view(std::as_bytes(std::span(shape.positions)), kArrayBuffer), "VEC3");
    positions["min"] = to_array(min);
    positions["max"] = to_array(max);
    Json normals = vertex_accessor(add_view(std::as_bytes(std::span(shape.normals)), kArrayBuffer), "VEC3");
    Json uvs = vertex_accessor(add_view(std::as_bytes(std::span(shape.uvs)), kArrayBuffer), "VEC2");

    const bool is_short = count < std::numeric_limits<std::uint16_t>::max();
    const std::vector<std::uint16_t> narrow(shape.indices.begin(),
                                            is_short ? shape.indices.end() : shape.indices.begin());
    const std::uint32_t view = is_short ? add_view(std::as_bytes(std::span(narrow)), kElementArrayBuffer)
                                        : add_view(std::as_bytes(std::span(shape.indices)), kElementArrayBuffer);
    Json indices = {{"bufferView", view},
                    {"componentType", is_short ? kUnsignedShort : kUnsignedInt},
                    {"count", shape.indices.size()},
                    {"type", "SCALAR"}};
    Json attributes = {{"POSITION", add_accessor(std::move(positions))},
                       {"NORMAL", add_accessor(std::move(normals))},
                       {"TEXCOORD_0", add_accessor(std::move(uvs))}};
    if (!part.joints.empty()) add_joints(part.joints, attributes);
    return {{"attributes", std::move(attributes)},
            {"indices", add_accessor(std::move(indices))},
            {"material", part.material}};
}

std::uint32_t GlbBuilder::add_mesh(const std::string& name, std::span<const PartSpec> parts) {
    Json primitives = Json::array();
    std::uint64_t triangles = 0;
    for (const PartSpec& part : parts) {
        primitives.push_back(primitive(part));
        triangles += part.shape.indices.size() / 3;
    }
    meshes_.push_back({{"name", name}, {"primitives", std::move(primitives)}});
    mesh_triangles_.push_back(triangles);
    return static_cast<std::uint32_t>(meshes_.size()) - 1u;
}

std::uint32_t GlbBuilder::add_mesh(const std::string& name, const Shape& shape, std::uint32_t material) {
    const std::array<PartSpec, 1> parts{PartSpec{shape, material}};
    return add_mesh(name, parts);
}

std::uint32_t GlbBuilder::add_light(Json light) {
    lights_.push_back(std::move(light));
    return static_cast<std::uint32_t>(lights_.size()) - 1u;
}

std::uint32_t GlbBuilder::add_camera(Json camera) {
    cameras_.push_back(std::move(camera));
    return static_cast<std::uint32_t>(cameras_.size()) - 1u;
}

std::uint32_t GlbBuilder::add_node(const NodeSpec& spec) {
    const std::uint32_t index = static_cast<std::uint32_t>(nodes_.size());
    Json node = {{"name", spec.name}};
    if (spec.translation_m != glm::dvec3(0.0)) node["translation"] = to_array(spec.translation_m);
    if (spec.rotation != glm::dquat(1.0, 0.0, 0.0, 0.0))
        node["rotation"] = {spec.rotation.x, spec.rotation.y, spec.rotation.z, spec.rotation.w};
    if (spec.mesh) {
        node["mesh"] = *spec.mesh;
        triangles_ += mesh_triangles_[*spec.mesh];
    }
    if (spec.camera) node["camera"] = *spec.camera;
    if (spec.light) node["extensions"]["KHR_lights_punctual"]["light"] = *spec.light;
    if (!spec.extras.is_null()) node["extras"] = spec.extras;
    nodes_.push_back(std::move(node));
    if (spec.parent)
        nodes_[*spec.parent]["children"].push_back(index);
    else
        top_nodes_.push_back(index);
    return index;
}

std::vector<std::byte> GlbBuilder::finish(const RootSpec& root) {
    Json root_node = {{"name", root.name}, {"children", top_nodes_}};
    if (root.translation_m != glm::dvec3(0.0)) root_node["translation"] = to_array(root.translation_m);
    if (root.scale != 1.0) root_node["scale"] = to_array(glm::dvec3(root.scale));
    nodes_.push_back(std::move(root_node));
    pad(binary_, std::byte{0});

    Json document = {{"asset", {{"version", "2.0"}, {"generator", "gnomon_scene_generator"}}},
                     {"scene", 0},
                     {"scenes", {{{"name", root.name}, {"nodes", {nodes_.size() - 1}}}}},
                     {"nodes", nodes_},
                     {"meshes", meshes_},
                     {"materials", materials_},
                     {"textures", textures_},
                     {"images", images_},
                     {"samplers", {{{"magFilter", kLinear}, {"minFilter", kLinearMipmapLinear}}}},
                     {"cameras", cameras_},
                     {"accessors", accessors_},
                     {"bufferViews", views_},
                     {"buffers", {{{"byteLength", binary_.size()}}}},
                     {"extensionsUsed", {"KHR_lights_punctual"}},
                     {"extensions", {{"KHR_lights_punctual", {{"lights", lights_}}}}}};
    if (!skins_.empty()) document["skins"] = skins_;
    if (!animations_.empty()) document["animations"] = animations_;
    const std::string text = document.dump();
    std::vector<std::byte> json(text.size());
    std::memcpy(json.data(), text.data(), text.size());
    pad(json, static_cast<std::byte>(' '));

    std::vector<std::byte> glb;
    put_u32(glb, kMagic);
    put_u32(glb, kVersion);
    put_u32(glb, static_cast<std::uint32_t>(kHeaderBytes + 2 * kChunkHeaderBytes + json.size() + binary_.size()));
    put_chunk(glb, kJsonChunk, json);
    put_chunk(glb, kBinaryChunk, binary_);
    return glb;
}

}  // namespace gnomon::game
