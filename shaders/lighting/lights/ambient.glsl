// Light from everywhere; never shadowed. It is brighter from above, as under a sky. C++ twin: AmbientRecord in
// systems/lighting/ambient.h.
#include "common/bindings.glsl"
layout(std140, binding = kAmbientBlock) uniform AmbientBlock {
    vec4 sky;      // rgb: lux from above, times w; w: what the picture holds for a radiance of 1
    vec4 ground;   // rgb: lux from below, times sky.w; w: what the picture holds for an exposed radiance of 1 that is
                   // shown unlit
} ambient;

// Returns the illuminance of a surface, lux times ambient.sky.w.
vec3 ambient_irradiance(vec3 normal) { return mix(ambient.ground.rgb, ambient.sky.rgb, 0.5 + 0.5 * normal.y); }

vec3 ambient_light(vec3 colour, vec3 normal) {
    const float kInversePi = 0.318309886;
    return colour * kInversePi * ambient_irradiance(normal);
}
