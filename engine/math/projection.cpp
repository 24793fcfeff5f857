#include "engine/math/projection.h"

#include <algorithm>
#include <limits>

namespace gnomon::math {

glm::dmat4 reversed_orthographic(double left, double right, double bottom, double top, double near_m, double far_m) {
    glm::dmat4 clip_from_view(0.0);
    clip_from_view[0][0] = 2.0 / (right - left);
    clip_from_view[1][1] = 2.0 / (top - bottom);
    clip_from_view[2][2] = 1.0 / (far_m - near_m);
    clip_from_view[3] = {-(right + left) / (right - left), -(top + bottom) / (top - bottom), far_m / (far_m - near_m),
                         1.0};
    return clip_from_view;
}

glm::dmat4 reversed_perspective(double left, double right, double bottom, double top, double near_m, double far_m) {
    glm::dmat4 clip_from_view(0.0);
    clip_from_view[0][0] = 2.0 / (right - left);
    clip_from_view[1][1] = 2.0 / (top - bottom);
    // Both depth terms reach their limits (0 and near) at an infinite far plane without a branch.
    clip_from_view[2] = {(right + left) / (right - left), (top + bottom) / (top - bottom), near_m / (far_m - near_m),
                         -1.0};
    clip_from_view[3][2] = near_m / (1.0 - near_m / far_m);
    return clip_from_view;
}

glm::dmat4 texture_from_clip() {
    glm::dmat4 m(1.0);
    m[0][0] = 0.5;
    m[1][1] = 0.5;
    m[3] = {0.5, 0.5, 0.0, 1.0};
    return m;
}

TwoFloat3 split(const glm::dvec3& value) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    TwoFloat3 out;
    for (int axis = 0; axis < 3; ++axis) {
        // Converting a double beyond the range of float is undefined; std::clamp lets NaN through.
        const double v = std::clamp(value[axis], -kLargest, kLargest);
        out.high[axis] = static_cast<float>(v);
        out.low[axis] = static_cast<float>(v - static_cast<double>(out.high[axis]));
    }
    return out;
}

}  // namespace gnomon::math
