#pragma once
#include <functional>
#include <memory>

#include "gnomon/assets.h"
#include "gnomon/registry.h"

namespace gnomon {

/// A world in motion that can be played again and again from its first frame, each time in the same way.
struct FaultScene {
    std::shared_ptr<const assets::MeshLibrary> library;
    std::shared_ptr<ecs::Registry> registry;
    std::function<void(int frame)> play;  // brings the world to that frame, from the one before or to the first
};

/// Makes a plane, boxes of every kind of material, and a light of each kind. Frame 1 brings one box more than the
/// instance buffer holds.
FaultScene box_scene();

/// Makes a scene of boxes with lights that test by rays: without a size, with a size, and without a map.
FaultScene exact_scene();

/// Makes a plane that catches shadows of a box, by a sun and a point.
FaultScene catcher_scene();

/// Makes the built-in scene as the game loads it: sun, guard lamp and lantern with their shadows, all that moves
/// moving.
FaultScene courtyard_scene();
/// Makes the same with a sun that splits its cascades by the depths of the picture before.
FaultScene sampled_courtyard_scene();

}  // namespace gnomon
