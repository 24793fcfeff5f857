#include "sample_game/support/built_in_scenes/look_rotation.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace gnomon::game {

glm::dquat facing(const glm::dvec3& forward) {
    const glm::dvec3 back = -glm::normalize(forward);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), back));
    return glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)));
}

glm::dquat turned(double degrees) { return glm::angleAxis(glm::radians(degrees), glm::dvec3(0.0, 1.0, 0.0)); }

}  // namespace gnomon::game
