// The casters' triangles themselves decide, by one ray from the receiver to the light. SHADOW_SHEETS: unless the light's map is
// certain (docs/exact.md).
#include "shadow/exact/light_ray.glsl"

// `normal`: of the surface; one ray does not ask.
float shadow_ray(float reach, dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    return lit_along(position_ca, way_to_light(position_ca), reach, error_m, receiver);
}

#ifdef SHADOW_SHEETS
#include "shadow/exact/certainty.glsl"

// `error_m`: how far position_ca may be off the surface.
Certainty certainty(vec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    ShadowPoint point = shadow_point(0, position_ca, normal, error_m, 0.0);
    int verdict = sheet_verdict(point, position_ca, error_m, receiver_casts(receiver));
    return Certainty(verdict, verdict == kUncertain ? sheet_reach(point, position_ca, error_m) : kNoEnd);
}
#endif
#include "shadow/exact/traced.glsl"
