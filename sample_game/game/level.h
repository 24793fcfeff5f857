#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/result.h"
#include "sample_game/game/collision_boxes.h"
#include "sample_game/game/light_exposure.h"

namespace gnomon::game {

/// A light that gives the player away.
struct Lamp {
    std::size_t node = 0;
    assets::LightData light;  // spot or point
};

/// Everything the rules of the game need to know of a scene. Plain data, no entities.
struct Level {
    std::vector<assets::Node> nodes;
    Occluders occluders;
    std::vector<Solid> solids = {};
    std::vector<Lamp> lamps = {};
    glm::dvec3 start_m{0.0};              // the player's feet
    double start_yaw_rad = 0.0;           // 0 looks along -Z, counter-clockwise seen from above
    math::Aabb goal;                      // reached when the feet are in it
    std::int32_t player = assets::kNone;  // node of the body, if the scene has one
    std::int32_t sun = assets::kNone;     // node that the time of day turns
};

/// Builds the level of the courtyard made with CourtyardOptions::game. Error: rule "game.level", with the missing node.
Result<Level> courtyard_level(const assets::SceneData& scene);

}  // namespace gnomon::game
