#pragma once
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gnomon::math {

/// Returns true if all numbers are finite: no NaN, no infinity.
template <class T>
bool is_finite(const glm::vec<3, T>& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool is_finite(const glm::dmat3& m) { return is_finite(m[0]) && is_finite(m[1]) && is_finite(m[2]); }
inline bool is_finite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return false;
    return true;
}

}  // namespace gnomon::math
