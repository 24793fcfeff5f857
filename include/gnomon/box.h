#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

namespace gnomon::math {

/// Axis-aligned box in double. A default box is empty (min > max).
struct Aabb {
    /// Least corner.
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    /// Greatest corner.
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};
    bool operator==(const Aabb&) const = default;
};

/// Returns true if the box contains no point; NaN counts as empty.
inline bool is_empty(const Aabb& b) { return !(b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z); }

}  // namespace gnomon::math

namespace gnomon::gl {

/// Rectangle of pixels; y up, as OpenGL counts.
struct Rect {
    std::int32_t x = 0, y = 0;           // lower left pixel
    std::int32_t width = 0, height = 0;  // pixels; 0: empty
    bool operator==(const Rect&) const = default;
};

}  // namespace gnomon::gl
