#include "engine/assets/gltf_animations.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "engine/assets/gltf_accessor.h"
#include "engine/assets/gltf_error.h"

namespace gnomon::assets::gltf {
namespace {

using nlohmann::json;

/// Property of a target path, and the shape of its values.
struct PathRow {
    std::string_view path;
    AnimatedProperty property;
    std::uint32_t width;  // numbers per value; weights: the number of targets
    int type;             // accessor type
    bool integers;        // normalised integers are allowed
};
constexpr PathRow kPaths[] = {
    {"translation", AnimatedProperty::translation, 3, TINYGLTF_TYPE_VEC3, false},
    {"rotation", AnimatedProperty::rotation, 4, TINYGLTF_TYPE_VEC4, true},
    {"scale", AnimatedProperty::scale, 3, TINYGLTF_TYPE_VEC3, false},
    {"weights", AnimatedProperty::weights, 0, TINYGLTF_TYPE_SCALAR, true},
};

const PathRow* row_of(const std::string& path) {
    const auto* found =
        std::find_if(std::begin(kPaths), std::end(kPaths), [&](const PathRow& r) { return r.path == path; });
    return found == std::end(kPaths) ? nullptr : found;
}

/// Returns true if the accessor's numbers are normalised (glTF 2.0, 3.11).
bool is_normalised(const tinygltf::Accessor& accessor) {
    return accessor.normalized && accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

class AnimationLoader {
public:
    AnimationLoader(Document& document, const std::vector<std::int32_t>& scene_nodes, SceneData& scene)
        : document_(document), scene_nodes_(scene_nodes), scene_(scene) {}

    void load(const json& raw, const std::string& where) {
        Animation animation;
        moved_.clear();
        animation.name = raw.value("name", std::string());
        for (std::size_t c = 0; c < raw["channels"].size(); ++c) {
            where_ = where + "/channels/" + std::to_string(c);
            const json& channel = raw["channels"][c];
            if (auto loaded = channel_of(channel, raw["samplers"][channel["sampler"].get<std::size_t>()]))
                add(animation, std::move(*loaded));
        }
        scene_.animations.push_back(std::move(animation));
    }

private:
    std::nullopt_t left_out(const std::string& reason) {
        document_.warn(where_ + ": left out, " + reason);
        return std::nullopt;
    }

    void add(Animation& animation, AnimationChannel channel) {
        if (moved_.emplace(channel.node, channel.property).second)
            animation.channels.push_back(std::move(channel));
        else
            left_out("another channel moves the same");
    }

    std::optional<AnimationChannel> channel_of(const json& raw, const json& sampler) {
        const json& target = raw["target"];
        const PathRow* row = row_of(target["path"].get<std::string>());
        if (!row) return left_out("its path is none of glTF 2.0");
        if (!target.contains("node")) return std::nullopt;
        AnimationChannel channel;
        channel.node = scene_nodes_[target["node"].get<std::size_t>()];
        if (channel.node == kNone) return std::nullopt;
        channel.property = row->property;
        channel.width = row->width;
        if (row->property == AnimatedProperty::weights) {
            const std::size_t targets = scene_.nodes[static_cast<std::size_t>(channel.node)].morph_weights.size();
            if (targets == 0) return left_out("its node has no morph targets");
            channel.width = static_cast<std::uint32_t>(targets);
        }
        const std::string interpolation = sampler.value("interpolation", std::string("LINEAR"));
        if (interpolation == "STEP") channel.interpolation = Interpolation::step;
        if (interpolation == "CUBICSPLINE") channel.interpolation = Interpolation::cubic;
        return with_keys(std::move(channel), *row, sampler["input"].get<int>(), sampler["output"].get<int>());
    }

    std::optional<AnimationChannel> with_keys(AnimationChannel channel, const PathRow& row, int input, int output) {
        const auto& times = document_.model.accessors[static_cast<std::size_t>(input)];
        const auto& values = document_.model.accessors[static_cast<std::size_t>(output)];
        if (times.type != TINYGLTF_TYPE_SCALAR || times.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
            return left_out("its times are not single floats");
        const bool is_float = values.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
        if (values.type != row.type || !(is_float || (row.integers && is_normalised(values))))
            return left_out("its values have a type that glTF does not allow here");
        const std::size_t per_key = (channel.interpolation == Interpolation::cubic ? 3u : 1u) *
                                    (row.type == TINYGLTF_TYPE_SCALAR ? channel.width : 1u);
        if (times.count == 0) return left_out("it has no keys");
        if (values.count / per_key != times.count || values.count % per_key != 0)
            return left_out("its values are not as many as its times ask for");
        document_.charge((times.count + values.count / per_key * channel.width * 3) * sizeof(float), where_);
        channel.times_s = read_floats(document_, input);
        channel.values = read_floats(document_, output);
        if (!std::is_sorted(channel.times_s.begin(), channel.times_s.end())) return left_out("its times do not rise");
        if (row.property == AnimatedProperty::rotation && !rotations_turn(channel))
            return left_out("a rotation has no length");
        return channel;
    }

    static bool rotations_turn(const AnimationChannel& channel) {
        const bool cubic = channel.interpolation == Interpolation::cubic;
        for (std::size_t key = 0; key < channel.times_s.size(); ++key) {
            const float* v = channel.values.data() + 4 * (cubic ? 3 * key + 1 : key);
            if (!(std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2]), std::abs(v[3])}) > 0.0f)) return false;
        }
        return true;
    }

    Document& document_;
    const std::vector<std::int32_t>& scene_nodes_;
    SceneData& scene_;
    std::string where_;                                          // current channel
    std::set<std::pair<std::int32_t, AnimatedProperty>> moved_;  // targets of the current animation
};

}  // namespace

void load_animations(Document& document, const std::vector<std::int32_t>& scene_nodes, SceneData& scene) {
    const json animations = document.json.value("animations", json::array());
    AnimationLoader loader(document, scene_nodes, scene);
    for (std::size_t a = 0; a < animations.size(); ++a) loader.load(animations[a], pointer("animations", a));
}

}  // namespace gnomon::assets::gltf
