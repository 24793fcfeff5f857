#include "sample_game/support/built_in_scenes/glb_writer.h"

#include <tiny_gltf.h>

#include <array>
#include <cstring>
#include <glm/common.hpp>
#include <limits>
#include <sstream>
#include <string_view>

namespace gnomon::game {
namespace {

constexpr std::size_t kAlignment = 4;

template <class V>
std::vector<double> numbers_of(const V& vector) {
    std::vector<double> numbers;
    for (glm::length_t i = 0; i < V::length(); ++i) numbers.push_back(static_cast<double>(vector[i]));
    return numbers;
}

template <class Item>
std::uint32_t add(std::vector<Item>& items, Item item) {
    items.push_back(std::move(item));
    return static_cast<std::uint32_t>(items.size()) - 1u;
}

tinygltf::Value value_of(const nlohmann::ordered_json& json) {
    if (json.is_boolean()) return tinygltf::Value(json.get<bool>());
    if (json.is_number_integer()) return tinygltf::Value(json.get<int>());
    if (json.is_number()) return tinygltf::Value(json.get<double>());
    if (json.is_string()) return tinygltf::Value(json.get<std::string>());
    if (json.is_array()) {
        tinygltf::Value::Array items;
        for (const auto& item : json) items.push_back(value_of(item));
        return tinygltf::Value(items);
    }
    tinygltf::Value::Object members;
    for (const auto& [key, member] : json.items()) members.emplace(key, value_of(member));
    return tinygltf::Value(members);
}

/// Lets a node carry a light. tinygltf 2.9 writes the member, and takes the extension away from nodes without it;
/// 2.7 has no such member.
template <class Node>
void set_light(Node& node, std::uint32_t light) {
    node.extensions["KHR_lights_punctual"] = value_of({{"light", light}});
    if constexpr (requires { node.light; }) node.light = static_cast<int>(light);
}

/// Blanks the end of infinite projections. tinygltf 2.7 writes 0 for it, which glTF forbids.
void blank_ends(std::string& glb) {
    constexpr std::string_view kEnd = R"("zfar":0.0,)";
    for (std::size_t at = glb.find(kEnd); at != std::string::npos; at = glb.find(kEnd, at))
        glb.replace(at, kEnd.size(), kEnd.size(), ' ');
}

}  // namespace

GlbBuilder::GlbBuilder() : model_(std::make_unique<tinygltf::Model>()) {
    model_->asset.version = "2.0";
    model_->asset.generator = "gnomon_scene_generator";
    model_->buffers.resize(1);
    tinygltf::Sampler sampler;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    model_->samplers.push_back(sampler);
}

GlbBuilder::~GlbBuilder() = default;

int GlbBuilder::add_view(std::span<const std::byte> bytes, int target) {
    std::vector<unsigned char>& binary = model_->buffers[0].data;
    binary.resize((binary.size() + kAlignment - 1) / kAlignment * kAlignment);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = binary.size();
    view.byteLength = bytes.size();
    view.target = target;
    binary.resize(binary.size() + bytes.size());
    if (!bytes.empty()) std::memcpy(binary.data() + view.byteOffset, bytes.data(), bytes.size());
    return static_cast<int>(add(model_->bufferViews, view));
}

int GlbBuilder::add_accessor(int view, int component_type, std::size_t count, int type) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.componentType = component_type;
    accessor.count = count;
    accessor.type = type;
    return static_cast<int>(add(model_->accessors, accessor));
}

int GlbBuilder::add_floats(std::span<const float> numbers, std::size_t width, int type) {
    const int added =
        add_accessor(add_view(std::as_bytes(numbers)), TINYGLTF_COMPONENT_TYPE_FLOAT, numbers.size() / width, type);
    // glTF requires the range of key times.
    if (width == 1) {
        tinygltf::Accessor& accessor = model_->accessors.back();
        accessor.minValues = {static_cast<double>(numbers.front())};
        accessor.maxValues = {static_cast<double>(numbers.back())};
    }
    return added;
}

std::uint32_t GlbBuilder::add_texture(const std::string& name, std::span<const std::uint8_t> png) {
    tinygltf::Image image;
    image.name = name;
    image.bufferView = add_view(std::as_bytes(png));
    image.mimeType = "image/png";
    tinygltf::Texture texture;
    texture.name = name;
    texture.sampler = 0;
    texture.source = static_cast<int>(add(model_->images, image));
    return add(model_->textures, texture);
}

std::uint32_t GlbBuilder::add_material(const MaterialSpec& spec) {
    tinygltf::Material material;
    material.name = spec.name;
    tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
    pbr.baseColorFactor = numbers_of(spec.base_colour);
    pbr.metallicFactor = static_cast<double>(spec.metallic);
    pbr.roughnessFactor = static_cast<double>(spec.roughness);
    if (spec.texture) pbr.baseColorTexture.index = static_cast<int>(*spec.texture);
    material.emissiveFactor = numbers_of(spec.emissive);
    if (spec.alpha_cutoff) {
        material.alphaMode = "MASK";
        material.alphaCutoff = static_cast<double>(*spec.alpha_cutoff);
    }
    if (spec.blended) {
        material.alphaMode = "BLEND";
        const double passed = static_cast<double>(spec.transmission);
        material.extensions["KHR_materials_transmission"] =
            tinygltf::Value(tinygltf::Value::Object{{"transmissionFactor", tinygltf::Value(passed)}});
    }
    material.doubleSided = spec.double_sided;
    return add(model_->materials, material);
}

std::uint32_t GlbBuilder::add_mesh(const std::string& name, std::span<const PartSpec> parts) {
    tinygltf::Mesh mesh;
    mesh.name = name;
    std::uint64_t triangles = 0;
    for (const PartSpec& part : parts) {
        const Shape& shape = part.shape;
        const std::size_t count = shape.positions.size();
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = static_cast<int>(part.material);
        const auto add_attribute = [&](const char* attribute, std::span<const std::byte> bytes, int type) {
            const int view = add_view(bytes, TINYGLTF_TARGET_ARRAY_BUFFER);
            primitive.attributes[attribute] = add_accessor(view, TINYGLTF_COMPONENT_TYPE_FLOAT, count, type);
        };
        add_attribute("POSITION", std::as_bytes(std::span(shape.positions)), TINYGLTF_TYPE_VEC3);
        glm::vec3 min(std::numeric_limits<float>::infinity()), max(-min);
        for (const glm::vec3& p : shape.positions) {
            min = glm::min(min, p);
            max = glm::max(max, p);
        }
        model_->accessors.back().minValues = numbers_of(min);
        model_->accessors.back().maxValues = numbers_of(max);
        add_attribute("NORMAL", std::as_bytes(std::span(shape.normals)), TINYGLTF_TYPE_VEC3);
        add_attribute("TEXCOORD_0", std::as_bytes(std::span(shape.uvs)), TINYGLTF_TYPE_VEC2);

        const bool is_short = count < std::numeric_limits<std::uint16_t>::max();
        const std::vector<std::uint16_t> narrow(shape.indices.begin(),
                                                is_short ? shape.indices.end() : shape.indices.begin());
        const auto bytes = is_short ? std::as_bytes(std::span(narrow)) : std::as_bytes(std::span(shape.indices));
        primitive.indices =
            add_accessor(add_view(bytes, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER),
                         is_short ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                         shape.indices.size(), TINYGLTF_TYPE_SCALAR);
        if (!part.joints.empty()) {
            std::vector<std::array<std::uint8_t, 4>> joints;
            std::vector<float> weights;
            for (const JointShare& share : part.joints) {
                joints.push_back({share.joint, share.other, 0, 0});
                weights.insert(weights.end(), {1.0f - share.of_other, share.of_other, 0.0f, 0.0f});
            }
            primitive.attributes["JOINTS_0"] =
                add_accessor(add_view(std::as_bytes(std::span(joints))), TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                             joints.size(), TINYGLTF_TYPE_VEC4);
            primitive.attributes["WEIGHTS_0"] = add_floats(weights, 4, TINYGLTF_TYPE_VEC4);
        }
        mesh.primitives.push_back(primitive);
        triangles += shape.indices.size() / 3;
    }
    mesh_triangles_.push_back(triangles);
    return add(model_->meshes, mesh);
}

std::uint32_t GlbBuilder::add_mesh(const std::string& name, const Shape& shape, std::uint32_t material) {
    const std::array<PartSpec, 1> parts{PartSpec{shape, material}};
    return add_mesh(name, parts);
}

std::uint32_t GlbBuilder::add_light(const LightSpec& spec) {
    tinygltf::Light light;
    light.type = spec.type;
    light.color = numbers_of(spec.colour);
    light.intensity = spec.intensity;
    light.range = spec.range_m;
    if (spec.cone) {
        light.spot.innerConeAngle = spec.cone->inner_rad;
        light.spot.outerConeAngle = spec.cone->outer_rad;
    }
    return add(model_->lights, light);
}

std::uint32_t GlbBuilder::add_camera(const CameraSpec& spec) {
    tinygltf::Camera camera;
    camera.name = spec.name;
    camera.type = "perspective";
    camera.perspective.yfov = spec.fov_y_rad;
    camera.perspective.znear = spec.near_m;
    return add(model_->cameras, camera);
}

std::uint32_t GlbBuilder::add_skin(const std::string& name, std::span<const JointSpec> joints) {
    tinygltf::Skin skin;
    skin.name = name;
    std::vector<float> matrices;
    for (const JointSpec& joint : joints) {
        skin.joints.push_back(static_cast<int>(joint.node));
        const glm::vec3 at(joint.rest_m);
        matrices.insert(matrices.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -at.x, -at.y, -at.z, 1});
    }
    skin.inverseBindMatrices = add_floats(matrices, 16, TINYGLTF_TYPE_MAT4);
    return add(model_->skins, skin);
}

std::uint32_t GlbBuilder::add_times(std::span<const float> times_s) {
    return static_cast<std::uint32_t>(add_floats(times_s, 1, TINYGLTF_TYPE_SCALAR));
}

void GlbBuilder::add_animation(const std::string& name, std::span<const ChannelSpec> channels) {
    tinygltf::Animation animation;
    animation.name = name;
    for (const ChannelSpec& spec : channels) {
        const bool turns = spec.path == "rotation";
        tinygltf::AnimationSampler sampler;
        sampler.input = static_cast<int>(spec.times);
        sampler.output = add_floats(spec.values, turns ? 4 : 3, turns ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
        tinygltf::AnimationChannel channel;
        channel.sampler = static_cast<int>(add(animation.samplers, sampler));
        channel.target_node = static_cast<int>(spec.node);
        channel.target_path = spec.path;
        animation.channels.push_back(channel);
    }
    model_->animations.push_back(animation);
}

std::uint32_t GlbBuilder::add_node(const NodeSpec& spec) {
    tinygltf::Node node;
    node.name = spec.name;
    if (spec.translation_m != glm::dvec3(0.0)) node.translation = numbers_of(spec.translation_m);
    if (spec.rotation != glm::dquat(1.0, 0.0, 0.0, 0.0))
        node.rotation = {spec.rotation.x, spec.rotation.y, spec.rotation.z, spec.rotation.w};
    if (spec.mesh) {
        node.mesh = static_cast<int>(*spec.mesh);
        triangles_ += mesh_triangles_[*spec.mesh];
    }
    if (spec.camera) node.camera = static_cast<int>(*spec.camera);
    if (spec.light) set_light(node, *spec.light);
    if (!spec.extras.is_null()) node.extras = value_of(spec.extras);
    const std::uint32_t index = add(model_->nodes, node);
    (spec.parent ? model_->nodes[*spec.parent].children : top_nodes_).push_back(static_cast<int>(index));
    return index;
}

void GlbBuilder::set_skin(std::uint32_t node, std::uint32_t skin) { model_->nodes[node].skin = static_cast<int>(skin); }

std::vector<std::byte> GlbBuilder::finish(const RootSpec& root) {
    tinygltf::Node node;
    node.name = root.name;
    node.children = top_nodes_;
    if (root.translation_m != glm::dvec3(0.0)) node.translation = numbers_of(root.translation_m);
    if (root.scale != 1.0) node.scale = numbers_of(glm::dvec3(root.scale));
    tinygltf::Scene scene;
    scene.name = root.name;
    scene.nodes = {static_cast<int>(add(model_->nodes, node))};
    model_->scenes = {scene};
    model_->defaultScene = 0;

    std::ostringstream stream;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(model_.get(), stream, false, true);
    std::string glb = stream.str();
    blank_ends(glb);
    std::vector<std::byte> bytes(glb.size());
    std::memcpy(bytes.data(), glb.data(), glb.size());
    return bytes;
}

}  // namespace gnomon::game
