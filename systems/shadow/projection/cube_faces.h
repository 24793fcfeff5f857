#pragma once
#include <cstdint>
#include <glm/ext/quaternion_double.hpp>
#include <glm/vec3.hpp>

/// How a light sees in all directions: the faces of a cube, and how far a single view may open.
namespace gnomon::shadow {

/// Half angle a single perspective map can hold at most: there, a texel at the rim is 1 / cos^2 = 33 times stretched
/// against the centre.
inline constexpr double kWidestMap_rad = 1.3962634015954636;

/// OpenGL's cube-map table (GL 4.5 core, table 8.19): where a face looks and how its texture axes lie.
struct CubeFace {
    glm::dvec3 axis_u, axis_v, axis_back;  // s and t grow along u and v; the face looks along -back
};
const CubeFace& cube_face(std::uint32_t face);

/// How a point light's cube lies in the world, from the cube's axes to the world's: askew, the same for all. What
/// people build runs along the world's axes; texels that do the same put the whole length of its edges off by the same
/// part of a texel, where texels askew to it are wrong to either side in turn, which a filter evens out
/// (docs/accuracy.md).
const glm::dquat& cube_turn();

}  // namespace gnomon::shadow
