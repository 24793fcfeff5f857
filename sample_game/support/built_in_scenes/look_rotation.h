#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace gnomon::game {

/// The rotation that turns -Z to `forward` (any length) with +Y as close to up as can be. `forward` is not vertical.
glm::dquat facing(const glm::dvec3& forward);
/// About +Y, counter-clockwise seen from above.
glm::dquat turned(double degrees);

}  // namespace gnomon::game
