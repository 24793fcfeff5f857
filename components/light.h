#pragma once
#include <glm/vec3.hpp>

namespace gnomon {

/// Limits of a light's size: a disk of sky of 30 degrees to either side, and a source as large as a town.
inline constexpr float kMostSunRadius_rad = 0.523598776f, kMostSourceRadius_m = 1.0e4f;

enum class LightKind : unsigned char { directional, spot, point };

/// A light as in KHR_lights_punctual: it shines along its own -Z (directional, spot).
struct Light {
    LightKind kind = LightKind::point;
    glm::vec3 colour{1.0f};        // linear, Rec. 709
    float intensity = 100.0f;      // directional: lux; spot and point: candela
    float range_m = 0.0f;          // spot and point: 0 means unlimited
    float inner_cone_rad = 0.0f;   // spot: half angle of full intensity, in [0, outer)
    float outer_cone_rad = 0.785398163f;  // spot: half angle where light ends, in (0, pi/2]
    /// Radius of the source that shines, metres, 0 to kMostSourceRadius_m. 0: a point, with hard shadows. Filters that
    /// soften by the source read it: pcss, pcss_moments, exact_soft.
    float source_radius_m = 0.0f;  // spot and point
    /// Angular radius of the disk in the sky, radians, 0 to kMostSunRadius_rad. The real sun: 0.00465. 0: a point.
    float sun_radius_rad = 0.0f;  // directional
};

}  // namespace gnomon
