#pragma once
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

/// Shapes of the built-in scene. Counter-clockwise triangles seen from outside, metres, Y up.
/// Shapes called closed have no boundary once vertices with identical position bits are welded.
namespace gnomon::game {

struct Shape {
    std::vector<glm::vec3> positions, normals;  // one normal and uv per position
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> indices;  // triangle list
};

/// Makes a closed box. Texture coordinates are in metres on each side.
Shape make_box(const glm::dvec3& min, const glm::dvec3& max);

/// Extrudes `profile` from z = -depth / 2 to +depth / 2; closed. The profile is a simple polygon, counter-clockwise in
/// x and y, without three points in a row on one line.
Shape make_extrusion(std::span<const glm::dvec2> profile, double depth);

enum class LatheNormals : unsigned char { creased, smooth };

/// Turns `outline` (radius, height) about Y; closed. It runs from bottom to top, with its solid on the left of the way
/// up. First and last radius must be 0, the others > 0. `sides` >= 3.
Shape make_lathe(std::span<const glm::dvec2> outline, std::uint32_t sides, LatheNormals normals);

/// Makes a closed ball about the origin.
Shape make_sphere(double radius, std::uint32_t sides, std::uint32_t rings);

/// Makes a closed round bar from `from` to `to`.
Shape make_bar(const glm::dvec3& from, const glm::dvec3& to, double radius, std::uint32_t sides);

/// Makes a closed ring in the plane y = 0.
Shape make_ring(double radius, double bar_radius, std::uint32_t segments, std::uint32_t sides);

/// Makes a flat rectangle spanned by `right` and `up` about `centre`, facing cross(right, up); open. uv: 0 to 1, v
/// down.
Shape make_card(const glm::dvec3& centre, const glm::dvec3& right, const glm::dvec3& up);

/// Makes a hanging cloth with `waves` vertical folds of depth `fold`; open. Its top edge is at y = 0, and it faces +z.
Shape make_cloth(double width, double height, double fold, double waves, std::uint32_t columns, std::uint32_t rows);

/// Adds `part` under `from_part` (rotation, uniform scale, translation) to `whole`.
void append(Shape& whole, const Shape& part, const glm::dmat4& from_part = glm::dmat4(1.0));

}  // namespace gnomon::game
