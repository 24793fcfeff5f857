#pragma once
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gnomon::embed {

/// Returns whether all numbers are finite.
inline bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
inline bool is_finite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return false;
    return true;
}

}  // namespace gnomon::embed
