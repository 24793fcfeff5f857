#pragma once
#include <optional>
#include <string>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/registry.h"
#include "gnomon/result.h"

/// The animations of a file on the entities that its nodes became.
namespace gnomon::game {

/// One property of one entity, over and over.
struct PlayedChannel {
    ecs::Entity entity;
    assets::AnimationChannel channel;
    double period_s = 0.0;  // length of its animation
};

/// Returns the channels of animation `which`, or of all at once, each from its own beginning when it ends. If several
/// move the same property of a node, the first in the file does. `nodes`: one entity per node.
std::vector<PlayedChannel> played_channels(const std::vector<assets::Animation>& animations,
                                           const std::vector<ecs::Entity>& nodes,
                                           std::optional<std::size_t> which = {});

/// Finds an animation by name, else by index. Error: rule "animation.unknown".
Result<std::size_t> find_animation(const std::vector<assets::Animation>& animations, const std::string& name_or_index);

/// Patches Transform and MorphWeights of each where they differ; others are not touched. Dead entities are passed over.
void play(const std::vector<PlayedChannel>& channels, double time_s, ecs::Registry& registry);

}  // namespace gnomon::game
