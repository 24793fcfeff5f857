#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "components/shadow_tuning.h"

namespace gnomon::shadow {

/// Where a sun stands when it is asked for a place: to look from in perspective, to count near_m and far_m from.
struct SunEye {
    glm::dvec3 position_ws_m{0.0};
    double distance_m = 0.0;  // from the middle of what is seen; 0 only where that is one point
};

/// Whether the eye's distance and angle are usable: finite, not negative, the angle within one map.
bool is_eye(const ShadowTuning::Projection& tuning);

/// `light_basis`: columns right, up, back. `points_ws`: what is seen, not empty; its middle is that of its box in the
/// light's axes. An eye distance of 0 stands where a cone of eye_angle_rad holds every point.
SunEye sun_eye(const glm::dmat3& light_basis, std::span<const glm::dvec3> points_ws,
               const ShadowTuning::Projection& tuning);

}  // namespace gnomon::shadow
