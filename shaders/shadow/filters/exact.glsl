// The casters' triangles themselves decide, by one ray from the receiver to the light. SHADOW_SHEETS: unless the light's map is
// certain (docs/exact.md).
#include "shadow/light_block.glsl"
#include "rays/walk.glsl"
#ifdef SHADOW_SHEETS
#include "shadow/exact/verdict.glsl"

// Whether the receiver's own surface is sure to be in the map; a blended one never is.
bool receiver_casts(uvec2 receiver) {
#ifdef LIGHT_PASS
    return false;
#else
    return light.filtering.x != 0 && receiver != kNoReceiver;
#endif
}

int certainty(vec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    ShadowPoint point = shadow_point(0, position_ca, normal, error_m, 0.0);
    return sheet_verdict(point, position_ca, error_m, receiver_casts(receiver));
}
#else
const int kCertainlyLit = 0, kUncertain = 2;
int certainty(vec3 position_ca, vec3 normal, float error_m, uvec2 receiver) { return kUncertain; }
#endif

// `receiver`: instance and triangle of the surface, or kNoReceiver; then error_m says how far off it position_ca may be.
float shadow_traced(dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    vec3 rounded_ca = vec3(position_ca);
    int found = certainty(rounded_ca, normal, error_m + kUnitRoundoff * length(rounded_ca), receiver);
    if (found != kUncertain) return found == kCertainlyLit ? 1.0 : 0.0;
#ifdef LIGHT_DIRECTIONAL
    const float kLast = kNoEnd;
    dvec3 along = dvec3(light.to_light.xyz) + dvec3(light.low.xyz);
#else
    const float kLast = 1.0;
    dvec3 along = dvec3(light.position.xyz) + dvec3(light.low.xyz) - position_ca;
#endif
    uint layers = uint(light.to_light.w + 0.5);
    return ray_blocked(ShadowRay(position_ca, along, kLast, error_m, receiver, layers)) ? 0.0 : 1.0;
}
