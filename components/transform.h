#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "engine/ecs/entity.h"

namespace gnomon {

/// Place of an entity relative to its parent, or to the world if `parent` is null. Maps a local point p to
/// translation_m + rotation * (scale * p). Positions are double, in metres, so that a scene at 1e8 m behaves like one
/// at the origin. A zero scale hides the entity's mesh; NaN or infinity quarantines the entity (see FrameReport).
struct Transform {
    glm::dvec3 translation_m{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // w, x, y, z; need not be unit length
    glm::dvec3 scale{1.0};
    ecs::Entity parent = ecs::kNull;
};

/// Place of an entity in the world: maps a local point p to basis * p + translation_ws_m. Written by the transform
/// system only, read by extraction.
struct WorldTransform {
    glm::dmat3 basis{1.0};
    glm::dvec3 translation_ws_m{0.0};
    bool operator==(const WorldTransform&) const = default;
};

}  // namespace gnomon
