// The casters' triangles themselves decide, by one ray from the receiver to the light. SHADOW_SHEETS: unless the light's map is
// certain (docs/exact.md).
#include "shadow/light_block.glsl"
#include "rays/walk.glsl"

// `receiver`: instance and triangle of the surface, or kNoReceiver; then error_m says how far off it position_ca may be.
float shadow_ray(dvec3 position_ca, float error_m, uvec2 receiver) {
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

#ifdef SHADOW_SHEETS
#include "shadow/exact/verdict.glsl"

// Whether the receiver's own surface is drawn into the map, as what is seen of all that casts is; a blended one is not.
bool receiver_casts(uvec2 receiver) {
#ifdef LIGHT_PASS
    return false;
#else
    return receiver != kNoReceiver && (cast_layers(instances[receiver.x]) & uint(light.to_light.w + 0.5)) != 0u;
#endif
}

int certainty(dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    vec3 rounded_ca = vec3(position_ca);
    float off_m = error_m + kUnitRoundoff * length(rounded_ca);
    ShadowPoint point = shadow_point(0, rounded_ca, normal, off_m, 0.0);
    return sheet_verdict(point, rounded_ca, off_m, receiver_casts(receiver));
}

float shadow_traced(dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    int found = certainty(position_ca, normal, error_m, receiver);
    return found == kUncertain ? shadow_ray(position_ca, error_m, receiver) : found == kCertainlyLit ? 1.0 : 0.0;
}
#else
float shadow_traced(dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    return shadow_ray(position_ca, error_m, receiver);
}
#endif
