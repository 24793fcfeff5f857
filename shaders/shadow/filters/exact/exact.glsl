// Shadows by the casters' triangles themselves: one ray from the receiver to the light. SHADOW_SHEETS: where the
// light's map is not certain (docs/explanation/exact.md).
#include "shadow/filters/exact/shadow_ray.glsl"

// Returns the share of the light that one ray finds. `normal`: of the surface; unused.
float shadow_ray(float reach, dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    return lit_along(position_ca, vec3(0.0), way_to_light(position_ca), reach, error_m, receiver);
}

#if SHADOW_SHEETS
#include "shadow/filters/exact/classification.glsl"

// Returns the map's verdict. `error_m`: how far position_ca may be off the surface.
int certainty(vec3 position_ca, float error_m, uvec2 receiver) {
    return sheet_verdict(sheet_place(position_ca, error_m), receiver_casts(receiver));
}

// Returns ShadowRay::reach where the verdict is uncertain.
float uncertain_reach(vec3 position_ca, float error_m) {
    return sheet_reach(sheet_place(position_ca, error_m));
}
#else
#include "shadow/filters/exact/no_map.glsl"
#endif
#ifdef AREAS_ALONE
#include "shadow/filters/exact/area_rays.glsl"
#else
#include "shadow/filters/exact/classify_or_trace.glsl"
#endif
