#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace gnomon::game {

/// Returns the rotation that turns -Z to `forward` (any length, not vertical), with +Y as close to up as can be.
glm::dquat facing(const glm::dvec3& forward);
/// Returns a rotation about +Y, counter-clockwise seen from above.
glm::dquat turned(double degrees);

}  // namespace gnomon::game
