#include "tests/fuzz/gltf_mutator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <limits>
#include <set>

#include "engine/assets/gltf_limits.h"
#include "engine/mesh/deformer.h"
#include "tests/unit/assets/gltf_builder.h"

namespace gnomon::test {
namespace {

/// Reads choices; zeros when they are spent.
class Choices {
public:
    explicit Choices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    bool empty() const { return at_ >= bytes_.size(); }
    std::uint8_t byte() { return empty() ? std::uint8_t{0} : bytes_[at_++]; }
    std::size_t below(std::size_t count) {
        const std::size_t high = byte();
        return count == 0 ? 0 : (high << 8 | byte()) % count;
    }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

/// Joints, bind matrices, morph targets, and an animation of every kind of channel and interpolation.
void add_living(GltfBuilder& builder) {
    json& primitive = builder.doc["meshes"][0]["primitives"][0];
    primitive["attributes"]["JOINTS_0"] = builder.add_accessor(std::vector<std::uint8_t>(12, 0), "VEC4");
    primitive["attributes"]["WEIGHTS_0"] =
        builder.add_accessor<std::uint8_t>({255, 0, 0, 0, 128, 127, 0, 0, 255, 0, 0, 0}, "VEC4", true);
    primitive["targets"] = json::array({{{"POSITION", 0}}});
    builder.doc["meshes"][0]["weights"] = json::array({0.5});
    const std::vector<float> unit = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    builder.push("skins", {{"joints", json::array({1})}, {"inverseBindMatrices", builder.add_accessor(unit, "MAT4")}});
    builder.doc["nodes"][0]["skin"] = 0;
    const int times = builder.add_accessor<float>({0, 1}, "SCALAR");
    const int points = builder.add_accessor<float>({0, 0, 0, 1, 2, 3}, "VEC3");
    const int turns = builder.add_accessor<std::int16_t>({0, 0, 0, 32767, 0, 32767, 0, 0}, "VEC4", true);
    const int shares = builder.add_accessor<float>({0, 0, 0, 0, 1, 0}, "SCALAR");
    const auto channel = [](int sampler, int node, const char* path) {
        return json{{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
    };
    builder.push("animations",
                 {{"samplers", json::array({{{"input", times}, {"output", points}},
                                            {{"input", times}, {"output", turns}, {"interpolation", "STEP"}},
                                            {{"input", times}, {"output", shares}, {"interpolation", "CUBICSPLINE"}}})},
                  {"channels", json::array({channel(0, 1, "translation"), channel(1, 1, "rotation"),
                                            channel(0, 0, "scale"), channel(2, 0, "weights")})}});
}

/// Makes a document that uses every feature of the loader.
GltfBuilder rich_seed() {
    GltfBuilder builder = triangle();
    const std::vector<std::uint8_t> which = {1};
    const std::vector<float> values = {2, 0, 0};
    const int index_view = builder.add_view(which.data(), which.size());
    const int value_view = builder.add_view(values.data(), values.size() * sizeof(float));
    builder.doc["accessors"][0]["sparse"] = {{"count", 1},
                                             {"indices", {{"bufferView", index_view}, {"componentType", kUByte}}},
                                             {"values", {{"bufferView", value_view}}}};
    json& attributes = builder.doc["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = builder.add_accessor<std::int8_t>({0, 0, 127, 0, 127, 0, 127, 0, 0}, "VEC3", true);
    attributes["TEXCOORD_0"] = builder.add_accessor<std::uint16_t>({0, 0, 65535, 0, 0, 65535}, "VEC2", true);
    attributes["COLOR_0"] = builder.add_accessor<std::uint8_t>({255, 0, 0, 0, 255, 9, 1, 2, 255}, "VEC3", true);
    const std::vector<std::uint8_t> strip = {0, 1, 2, 1, 0};
    const int corners = builder.add_accessor<std::uint8_t>(strip, "SCALAR");
    builder.doc["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", 0}}}, {"indices", corners}, {"mode", 5}, {"material", 0}});
    builder.doc["extensionsUsed"] = {"KHR_mesh_quantization", "KHR_lights_punctual", "KHR_texture_transform"};
    const int image_view = builder.add_view("\x89PNG\r\n\x1a\n", 8);
    builder.push("images", {{"bufferView", image_view}});
    builder.push("images", {{"uri", "data:image/png;base64,iVBORw0KGgo="}});
    builder.push("samplers", {{"wrapS", 33071}});
    builder.push("textures", {{"source", 0}, {"sampler", 0}});
    builder.push("textures", {{"source", 1}});
    builder.push(
        "materials",
        {{"alphaMode", "MASK"},
         {"alphaCutoff", 0.5},
         {"emissiveFactor", {1, 1, 1}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}}}},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 1, 1, 1}},
           {"baseColorTexture",
            {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}, {"rotation", 1}}}}}}}}}});
    builder.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}, {"zfar", 10}}}});
    builder.push("cameras",
                 {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 10}}}});
    builder.doc["extensions"]["KHR_lights_punctual"]["lights"] =
        json::array({{{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}}}, {"range", 9}, {"color", {1, 1, 1}}},
                     {{"type", "directional"}, {"extras", {{"shadow", false}}}}});
    builder.push("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"extras", {{"shadow", false}}}});
    builder.push("nodes", {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1}}, {"children", {1, 0}}});
    builder.push("nodes", {{"camera", 0},
                           {"rotation", {0, 0, 0, 1}},
                           {"scale", {1, 1, 1}},
                           {"extras", {{"motion", {{"kind", "spin"}, {"axis", {0, 1, 0}}, {"period_s", 2}}}}}});
    builder.doc["scenes"] = json::array({{{"nodes", {2, 3}}}});
    builder.doc["scene"] = 0;
    add_living(builder);
    return builder;
}

json odd_value(Choices& choices) {
    switch (choices.below(24)) {
        case 0:
            return -1;
        case 1:
            return 0;
        case 2:
            return 1;
        case 3:
            return choices.byte();
        case 4:
            return 5120 + choices.byte() % 8;
        case 5:
            return std::numeric_limits<std::int32_t>::max();
        case 6:
            return std::numeric_limits<std::uint32_t>::max();
        case 7:
            return std::numeric_limits<std::int64_t>::min();
        case 8:
            return std::numeric_limits<std::uint64_t>::max();
        case 9:
            return std::uint64_t{1} << choices.byte() % 64;
        case 10:
            return 0.5;
        case 11:
            return 1e308;
        case 12:
            return -1e-320;
        case 13:
            return 1e39;
        case 14:
            return "";
        case 15:
            return "data:,%41";
        case 16:
            return "../x";
        case 17:
            return "MAT4";
        case 18:
            return nullptr;
        case 19:
            return true;
        case 20:
            return json::array();
        case 21:
            return json::object();
        case 22:
            return json::array({0, choices.byte(), 1e10});
        default:
            return json::array({odd_value(choices)});  // ends: spent choices give 0
    }
}

json small_index(Choices& choices) { return choices.byte() % 8; }

/// Chooses a new value, mostly of the old one's type: a wrong type is refused early and hides what lies behind.
json replacement(const json& old, Choices& choices) {
    if (choices.byte() % 16 == 0) return odd_value(choices);
    if (old.is_number_integer() && choices.byte() % 2 == 0) return small_index(choices);
    for (int attempt = 0; attempt < 4; ++attempt) {
        json value = odd_value(choices);
        const bool alike = old.is_number_integer() ? value.is_number_integer()
                           : old.is_number()       ? value.is_number()
                                                   : value.type() == old.type();
        if (alike) return value;
    }
    return old;
}

/// Picks a value somewhere in the document, each step chosen.
json* pick(json& root, Choices& choices) {
    json* at = &root;
    while (at->is_structured() && !at->empty()) {
        const std::size_t member = choices.below(at->size() + (at == &root ? 0 : 1));
        if (member == at->size()) break;
        at = &std::next(at->begin(), static_cast<std::ptrdiff_t>(member)).value();
    }
    return at;
}

void edit_document(json& document, Choices& choices) {
    json* const target = pick(document, choices);
    switch (choices.below(6)) {
        case 0: {
            const json copy = *pick(document, choices);
            if (copy.type() == target->type() || choices.byte() % 16 == 0) *target = copy;
            return;
        }
        case 1:
            if (target->is_array()) target->push_back(target->empty() ? small_index(choices) : (*target)[0]);
            return;
        case 2:
            if (target->is_structured() && !target->empty() && choices.byte() % 4 == 0) {
                target->erase(std::next(target->begin(), static_cast<std::ptrdiff_t>(choices.below(target->size()))));
            }
            return;
        case 3:
            if (target->is_number_integer()) {  // unsigned, so that the extremes wrap around
                *target = static_cast<std::int64_t>(target->get<std::uint64_t>() + choices.byte() % 9 - 4);
            }
            return;
        default:
            *target = replacement(json(*target), choices);
    }
}

[[noreturn]] void broken(const char* promise) {
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
}

bool is_index(std::int32_t index, std::size_t count) {
    return index >= assets::kNone && index < static_cast<std::int32_t>(count);
}

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_mesh(const assets::Mesh& mesh, std::size_t materials) {
    std::size_t next = 0;
    for (const auto& submesh : mesh.submeshes) {
        if (submesh.first_index != next || submesh.material >= materials) broken("submeshes cover the indices");
        next += submesh.index_count;
    }
    if (next != mesh.indices.size() || next % 3 != 0) broken("submeshes cover the indices");
    for (const std::uint32_t index : mesh.indices) {
        if (index >= mesh.vertices.size()) broken("indices in range");
        const glm::vec3 size = glm::abs(mesh.vertices[index].position_ms);
        if (!(std::max({size.x, size.y, size.z}) <= assets::gltf::kMaxPosition_ms)) broken("corners near the origin");
    }
    if (!mesh.colours.empty() && mesh.colours.size() != mesh.vertices.size()) broken("a colour per vertex or none");
    for (const glm::vec4& colour : mesh.colours)
        for (int i = 0; i < 4; ++i)
            if (!(colour[i] >= 0.0F && colour[i] <= 1.0F)) broken("colours from 0 to 1");
    for (const auto& vertex : mesh.vertices) {
        if (!finite(vertex.position_ms) || !finite(vertex.normal_ms) || !finite({vertex.uv, 0.0F}))
            broken("finite vertices");
        const float length = glm::length(vertex.normal_ms);
        if (length != 0.0F && std::abs(length - 1.0F) > 1e-5F) broken("unit normals");
    }
}

void check_deformer(const assets::Mesh& mesh) {
    const assets::Deformer& deformer = *mesh.deformer;
    const std::size_t vertices = mesh.vertices.size();
    for (const auto& target : deformer.targets)
        for (const auto* part : {&target.positions, &target.normals})
            if (!part->empty() && part->size() != vertices) broken("a target has every vertex or none");
    if (!deformer.has_skin()) return;
    if (deformer.first_influence.size() != vertices + 1 ||
        deformer.first_influence.back() != deformer.influences.size())
        broken("influences of every vertex");
    for (std::size_t v = 0; v < vertices; ++v) {
        double sum = 0.0;
        for (std::uint32_t i = deformer.first_influence[v]; i < deformer.first_influence[v + 1]; ++i)
            sum += static_cast<double>(deformer.influences[i].weight);
        if (!(std::abs(sum - 1.0) < 1e-5)) broken("weights sum to 1");
    }
}

/// Checks that every mesh that bends is placed once and can be bent at rest, and that any time of any animation can be
/// sampled.
void check_living(const assets::SceneData& scene) {
    std::set<std::int32_t> placed;
    std::vector<assets::Vertex> bent;
    for (const auto& node : scene.nodes) {
        if (!is_index(node.skin, scene.skins.size())) broken("node references in range");
        if (node.mesh == assets::kNone) continue;
        const assets::Mesh& mesh = scene.meshes[static_cast<std::size_t>(node.mesh)];
        if (!mesh.deformer) continue;
        check_deformer(mesh);
        if (!placed.insert(node.mesh).second) broken("a mesh that bends is placed by one node");
        if (mesh.deformer->has_skin() != (node.skin != assets::kNone)) broken("a skin where joints are followed");
        if (node.morph_weights.size() != mesh.deformer->targets.size()) broken("a weight per target");
        std::vector<glm::dmat4x3> joints;
        if (node.skin != assets::kNone) joints = scene.skins[static_cast<std::size_t>(node.skin)].inverse_bind;
        if (mesh.deformer->joint_bounds_ms.size() > joints.size()) broken("joints in range");
        assets::deform(mesh, {joints, node.morph_weights}, bent);
        (void)assets::posed_bounds(mesh, {joints, node.morph_weights});
    }
    for (const auto& animation : scene.animations)
        for (const auto& channel : animation.channels) {
            if (channel.node < 0 || !is_index(channel.node, scene.nodes.size())) broken("channels move nodes");
            std::vector<double> out(channel.width);
            for (const double time_s : {-1.0, 0.0, 0.3, 1.0, 9.0}) assets::sample(channel, time_s, out);
        }
}

}  // namespace

std::vector<std::byte> mutated_gltf(std::span<const std::uint8_t> bytes) {
    static const GltfBuilder kRich = rich_seed();
    static const GltfBuilder kPlain = triangle();
    Choices choices(bytes);
    const std::uint8_t shape = choices.byte();
    GltfBuilder builder = (shape & 1U) != 0 ? kPlain : kRich;
    while (!choices.empty()) {
        if (choices.byte() % 8 == 0) {
            const std::size_t at = choices.below(builder.binary.size());
            builder.binary[at] = static_cast<std::byte>(choices.byte());
        } else {
            edit_document(builder.doc, choices);
        }
    }
    return (shape & 2U) != 0 ? builder.gltf() : builder.glb();
}

void load_and_check(std::span<const std::byte> file) {
    const Result<assets::SceneData> result = assets::load_gltf_memory(file, {}, "fuzz.gltf");
    if (!result) {
        const Error& error = result.error();
        if (error.rule.empty() || error.file.empty() || to_line(error).find('\n') != std::string::npos) {
            broken("an error is one line with a rule and a file");
        }
        return;
    }
    const assets::SceneData& scene = result.value();
    if (scene.materials.empty()) broken("at least one material");
    for (const auto& mesh : scene.meshes) check_mesh(mesh, scene.materials.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const auto& node = scene.nodes[i];
        if (!is_index(node.parent, i)) broken("parents before children");
        if (!is_index(node.mesh, scene.meshes.size()) || !is_index(node.light, scene.lights.size()) ||
            !is_index(node.camera, scene.cameras.size())) {
            broken("node references in range");
        }
        if (!(std::abs(glm::length(node.rotation) - 1.0) < 1e-9)) broken("unit rotation");
        if (!(std::abs(node.translation_m.x) <= std::numeric_limits<double>::max())) broken("finite nodes");
    }
    check_living(scene);
    for (const auto& light : scene.lights) {
        if (!std::isfinite(light.intensity) || !finite(light.colour) ||
            !(light.inner_cone_rad <= light.outer_cone_rad)) {
            broken("lights are lights");
        }
    }
}

}  // namespace gnomon::test
