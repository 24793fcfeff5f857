#include "sample_game/support/scene/animation_player.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <utility>

#include "gnomon/components.h"
#include "sample_game/support/settings/parse_number.h"

namespace gnomon::game {
namespace {

using assets::AnimatedProperty;

void put(AnimatedProperty property, const std::array<double, 4>& v, Transform& transform) {
    if (property == AnimatedProperty::translation) transform.translation_m = {v[0], v[1], v[2]};
    if (property == AnimatedProperty::scale) transform.scale = {v[0], v[1], v[2]};
    if (property == AnimatedProperty::rotation) transform.rotation = {v[3], v[0], v[1], v[2]};
}

bool same(const Transform& a, const Transform& b) {
    return a.translation_m == b.translation_m && a.rotation == b.rotation && a.scale == b.scale;
}

void play_weights(const PlayedChannel& played, double time_s, ecs::Registry& registry) {
    std::vector<double> values(played.channel.width);
    assets::sample(played.channel, time_s, values);
    const std::vector<float> weights(values.begin(), values.end());
    const MorphWeights* now = registry.get<MorphWeights>(played.entity);
    if (!now || now->weights == weights) return;
    registry.patch<MorphWeights>(played.entity, [&](MorphWeights& morph) { morph.weights = weights; });
}

}  // namespace

std::vector<PlayedChannel> played_channels(const std::vector<assets::Animation>& animations,
                                           const std::vector<ecs::Entity>& nodes, std::optional<std::size_t> which) {
    std::vector<PlayedChannel> played;
    std::set<std::pair<std::int32_t, AnimatedProperty>> taken;
    for (std::size_t a = 0; a < animations.size(); ++a) {
        if (which && *which != a) continue;
        const double period_s = assets::duration_s(animations[a]);
        for (const assets::AnimationChannel& channel : animations[a].channels)
            if (taken.emplace(channel.node, channel.property).second)
                played.push_back({nodes[static_cast<std::size_t>(channel.node)], channel, period_s});
    }
    return played;
}

Result<std::size_t> find_animation(const std::vector<assets::Animation>& animations, const std::string& name_or_index) {
    const auto named = std::find_if(animations.begin(), animations.end(),
                                    [&](const assets::Animation& a) { return a.name == name_or_index; });
    if (named != animations.end()) return static_cast<std::size_t>(named - animations.begin());
    const auto index = read_count(name_or_index);
    if (index && *index < animations.size()) return static_cast<std::size_t>(*index);

    constexpr std::size_t kShown = 8;
    std::string known;
    for (std::size_t i = 0; i < std::min(animations.size(), kShown); ++i)
        known += (i == 0 ? "" : ", ") + (animations[i].name.empty() ? std::to_string(i) : animations[i].name);
    if (animations.size() > kShown) known += ", ...";
    return Error{.message = on_one_line("--animation: no animation '" + name_or_index + "'; the scene has " +
                                        (known.empty() ? "none" : known)),
                 .rule = "animation.unknown"};
}

void play(const std::vector<PlayedChannel>& channels, double time_s, ecs::Registry& registry) {
    for (const PlayedChannel& played : channels) {
        const double now_s = assets::looped_s(time_s, played.period_s);
        if (played.channel.property == AnimatedProperty::weights) {
            play_weights(played, now_s, registry);
            continue;
        }
        const Transform* before = registry.get<Transform>(played.entity);
        if (!before) continue;
        std::array<double, 4> value{};
        assets::sample(played.channel, now_s, std::span(value).first(played.channel.width));
        Transform now = *before;
        put(played.channel.property, value, now);
        if (!same(*before, now)) registry.patch<Transform>(played.entity, [&](Transform& t) { t = now; });
    }
}

}  // namespace gnomon::game
