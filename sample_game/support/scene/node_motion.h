#pragma once
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/components.h"
#include "gnomon/registry.h"

/// Moving casters and lights of the sample scenes: assets::Node::Motion as a function of time.
namespace gnomon::game {

/// Moves `rest` by `motion` at scene time `time_s`. The axis lies in the node's own frame, with any length.
/// spin: rotation about the axis once per period, counter-clockwise. swing: angle amplitude * sin(turns).
/// slide: offset axis * amplitude * sin(turns); turns is 2 pi (time_s / period_s + phase).
/// Returns `rest` for a still kind, an axis without direction, a period that is not > 0, or any number that is not
/// finite.
Transform moved(const Transform& rest, const assets::Node::Motion& motion, double time_s);

struct MovingEntity {
    ecs::Entity entity;
    Transform rest;
    assets::Node::Motion motion;
};

/// Patches the Transform of each; others are not touched. Dead entities are passed over.
void apply_motion(const std::vector<MovingEntity>& moving, double time_s, ecs::Registry& registry);

}  // namespace gnomon::game
