#include "systems/shadow/projection/cube_faces.h"

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace gnomon::shadow {

const CubeFace& cube_face(std::uint32_t face) {
    static const std::array<CubeFace, 6> kFaces = {{
        {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}},  // +X
        {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}},    // -X
        {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},    // +Y
        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},    // -Y
        {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},   // +Z
        {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},   // -Z
    }};
    return kFaces[face % 6];
}

const glm::dquat& cube_turn() {
    // The world's axes and their diagonals (of two and of three axes) stay clear of axes and diagonals of the cube.
    static const glm::dquat kTurn = glm::normalize(glm::dquat(5.0, 1.0, 2.0, 1.0));
    return kTurn;
}

}  // namespace gnomon::shadow
