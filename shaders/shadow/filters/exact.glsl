// The casters' triangles themselves decide, by one ray from the receiver to the light; no map.
#include "shadow/light_block.glsl"
#include "rays/walk.glsl"

// `receiver`: instance and triangle of the surface, or kNoReceiver; then error_m says how far off it position_ca may be.
float shadow_traced(dvec3 position_ca, float error_m, uvec2 receiver) {
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
