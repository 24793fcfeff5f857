#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace gnomon::shadow {

/// Least and greatest coordinates of points. Inverted and infinite where there are no points.
struct Extents {
    glm::dvec3 low, high;
};

/// Returns the extents of `p * axes` over all points, exact to the bit. Points with a NaN do not count.
Extents extents_along(const glm::dmat3& axes, std::span<const glm::dvec3> points);

}  // namespace gnomon::shadow
