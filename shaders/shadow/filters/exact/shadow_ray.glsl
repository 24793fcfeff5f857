// Ray from a receiver to a place of the light, tested against the casters' own triangles.
#include "shadow/lookup/row_flags.glsl"
#include "shadow/lookup/light_block.glsl"
#include "ray_tracing/bvh_traversal.glsl"

// Returns the way to the light's middle; of a sun only its direction.
dvec3 way_to_light(dvec3 position_ca) {
    if (kIsSun) return dvec3(light.to_light.xyz) + dvec3(light.low.xyz);
    return dvec3(light.position.xyz) + dvec3(light.low.xyz) - position_ca;
}

// Returns 1 if the ray is free, else 0. It begins at position_ca + beside_m. `reach`: ShadowRay::reach; kNoEnd: not known.
// `receiver`: instance and triangle of the surface, or kNoReceiver: then error_m is how far off it position_ca may be,
// metres.
float lit_along(dvec3 position_ca, vec3 beside_m, dvec3 along, float reach, float error_m, uvec2 receiver) {
    const float kLast = kIsSun ? kNoEnd : 1.0;
    uint layers = uint(light.to_light.w + 0.5);
    ShadowRay ray = ShadowRay(position_ca + dvec3(beside_m), -beside_m, along, kLast, min(reach, kLast), error_m, receiver, layers);
    return ray_blocked(ray) ? 0.0 : 1.0;
}
