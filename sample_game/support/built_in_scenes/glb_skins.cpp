#include <array>

#include "sample_game/support/built_in_scenes/glb_writer.h"

namespace gnomon::game {
namespace {

// Constants of the glTF 2.0 specification.
constexpr int kUnsignedByte = 5121, kFloat = 5126;

}  // namespace

std::uint32_t GlbBuilder::add_floats(std::span<const float> numbers, std::size_t width, const char* type) {
    Json accessor = {{"bufferView", add_view(std::as_bytes(numbers), std::nullopt)},
                     {"componentType", kFloat},
                     {"count", numbers.size() / width},
                     {"type", type}};
    // glTF requires the range of key times.
    if (width == 1) {
        accessor["min"] = {numbers.front()};
        accessor["max"] = {numbers.back()};
    }
    return add_accessor(std::move(accessor));
}

void GlbBuilder::add_joints(std::span<const JointShare> shares, Json& attributes) {
    std::vector<std::array<std::uint8_t, 4>> joints;
    std::vector<float> weights;
    for (const JointShare& share : shares) {
        joints.push_back({share.joint, share.other, 0, 0});
        weights.insert(weights.end(), {1.0f - share.of_other, share.of_other, 0.0f, 0.0f});
    }
    attributes["JOINTS_0"] = add_accessor({{"bufferView", add_view(std::as_bytes(std::span(joints)), std::nullopt)},
                                           {"componentType", kUnsignedByte},
                                           {"count", joints.size()},
                                           {"type", "VEC4"}});
    attributes["WEIGHTS_0"] = add_floats(weights, 4, "VEC4");
}

std::uint32_t GlbBuilder::add_skin(const std::string& name, std::span<const JointSpec> joints) {
    Json nodes = Json::array();
    std::vector<float> matrices;
    for (const JointSpec& joint : joints) {
        nodes.push_back(joint.node);
        const glm::vec3 at(joint.rest_m);
        matrices.insert(matrices.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -at.x, -at.y, -at.z, 1});
    }
    skins_.push_back(
        {{"name", name}, {"joints", std::move(nodes)}, {"inverseBindMatrices", add_floats(matrices, 16, "MAT4")}});
    return static_cast<std::uint32_t>(skins_.size()) - 1u;
}

std::uint32_t GlbBuilder::add_times(std::span<const float> times_s) { return add_floats(times_s, 1, "SCALAR"); }

void GlbBuilder::add_animation(const std::string& name, std::span<const ChannelSpec> channels) {
    Json samplers = Json::array(), targets = Json::array();
    for (const ChannelSpec& channel : channels) {
        const bool turns = channel.path == "rotation";
        const std::uint32_t values = add_floats(channel.values, turns ? 4 : 3, turns ? "VEC4" : "VEC3");
        samplers.push_back({{"input", channel.times}, {"output", values}, {"interpolation", "LINEAR"}});
        targets.push_back(
            {{"sampler", samplers.size() - 1}, {"target", {{"node", channel.node}, {"path", channel.path}}}});
    }
    animations_.push_back({{"name", name}, {"samplers", std::move(samplers)}, {"channels", std::move(targets)}});
}

}  // namespace gnomon::game
