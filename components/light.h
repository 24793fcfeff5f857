#pragma once
#include <glm/vec3.hpp>

namespace gnomon {

enum class LightKind : unsigned char { directional, spot, point };

/// A light as in KHR_lights_punctual: it shines along its own -Z (directional, spot).
struct Light {
    LightKind kind = LightKind::point;
    glm::vec3 colour{1.0f};        // linear, Rec. 709
    float intensity = 100.0f;      // directional: lux; spot and point: candela
    float range_m = 0.0f;          // spot and point: 0 means unlimited
    float inner_cone_rad = 0.0f;   // spot: half angle of full intensity, in [0, outer)
    float outer_cone_rad = 0.785398163f;  // spot: half angle where light ends, in (0, pi/2]
};

}  // namespace gnomon
