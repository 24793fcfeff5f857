#pragma once
#include <cstdint>
#include <glm/ext/quaternion_double.hpp>
#include <glm/vec3.hpp>

/// Faces of a light's cube, and the widest angle of a single view.
namespace gnomon::shadow {

/// Largest half angle of a single perspective map, radians: 80 degrees. A texel at its rim is stretched by 1 / cos^2 =
/// 33 against one at the centre.
inline constexpr double kWidestMap_rad = 1.3962634015954636;

/// Axes of a cube map's face (GL 4.5 core, table 8.19).
struct CubeFace {
    glm::dvec3 axis_u, axis_v, axis_back;  // s and t grow along u and v; the face looks along -back
};
const CubeFace& cube_face(std::uint32_t face);

/// Returns the rotation from the axes of a point light's cube to the world's: oblique, and the same for all lights.
/// Buildings run along the world's axes. Texels along the same axes would displace a whole edge by the same part of a
/// texel. The errors of oblique texels alternate along the edge, so that a filter evens them out
/// (docs/results/accuracy.md).
const glm::dquat& cube_turn();

}  // namespace gnomon::shadow
