#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "gnomon/shadow_tuning.h"

namespace gnomon::shadow {

/// Position that stands for a sun: apex of its perspective view, and origin of its near_m and far_m.
struct SunViewpoint {
    glm::dvec3 position_ws_m{0.0};
    double distance_m = 0.0;  // from the middle of the visible receivers; 0 only where these are one point
};

/// Returns true if the eye's distance and angle are usable: finite, not negative, the angle within one map.
bool is_eye(const ShadowTuning::Projection& tuning);

/// Computes the eye of a sun. `light_basis`: columns right, up, back. `points_ws`: corners of visible receivers, not
/// empty; their middle is that of their bounding box in the light's axes. eye_distance_m 0: the distance at which a
/// cone of eye_angle_rad contains every point.
SunViewpoint sun_viewpoint(const glm::dmat3& light_basis, std::span<const glm::dvec3> points_ws,
                           const ShadowTuning::Projection& tuning);

}  // namespace gnomon::shadow
