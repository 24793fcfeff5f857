#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace gnomon::shadow {

/// The least and the greatest coordinates of points; infinite the wrong way round where there are none.
struct Extents {
    glm::dvec3 low, high;
};

/// Of `p * axes` over all points, to the bit. Points with a NaN do not count.
Extents extents_along(const glm::dmat3& axes, std::span<const glm::dvec3> points);

}  // namespace gnomon::shadow
