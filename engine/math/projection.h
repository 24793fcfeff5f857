#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gnomon::math {

/// All projections are for glClipControl(LOWER_LEFT, ZERO_TO_ONE) with reversed depth: near maps to 1, far to 0. View
/// space looks along -Z.

/// Builds an orthographic projection: x in [left, right], y in [bottom, top], distance -z in [near, far]. near may be
/// negative, far must be finite.
glm::dmat4 reversed_orthographic(double left, double right, double bottom, double top, double near_m, double far_m);

/// Builds an off-centre perspective given by tangents: x/-z in [left, right], y/-z in [bottom, top]. 0 < near < far;
/// far may be infinite.
glm::dmat4 reversed_perspective(double left, double right, double bottom, double top, double near_m, double far_m);

/// Maps clip space [-1,1]x[-1,1]x[0,1] to texture space [0,1]^3.
glm::dmat4 texture_from_clip();

/// Double split into two floats: high + low == value to 2^-48 relative (2^-149 absolute near zero). Saturates beyond
/// the range of float; NaN stays NaN.
struct TwoFloat3 {
    glm::vec3 high{0.0f};
    glm::vec3 low{0.0f};
    bool operator==(const TwoFloat3&) const = default;
};
TwoFloat3 split(const glm::dvec3& value);

}  // namespace gnomon::math
