// Shadows of a source with a size: the share of it that is seen, by light.filtering.y rays. SHADOW_SHEETS: where the
// light's map is not certain that it is seen whole or not at all (docs/explanation/exact_proof.md).
#include "shadow/filters/exact/shadow_ray.glsl"
#include "shadow/filters/disk/noise_seed.glsl"
#include "shadow/filters/disk/stratified_disk.glsl"
#if SHADOW_SPREAD
#include "shadow/filters/area_spread.glsl"
#endif
#if LIGHT_AREA
#include "shadow/filters/exact/source_rays.glsl"
#else

// Returns the share of rays that reach the light, among rays that leave the surface along `normal`. It ignores `reach`,
// which bounds the ray to the light's middle alone. SHADOW_SPREAD: each ray begins at a place of its own.
float shadow_ray(float reach, dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    dvec3 middle = way_to_light(position_ca);
    vec3 toward = normalize(vec3(middle));
    vec3 helper = abs(toward.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 right = normalize(cross(toward, helper)), up = cross(toward, right);
    vec2 seed = cell_seed(vec3(position_ca));
    int lit = 0, rays = 0;
    vec3 beside_m = vec3(0.0);
#if SHADOW_SPREAD
    PixelArea area = pixel_area(vec3(position_ca), normal);
#endif
    for (int i = 0; i < light.filtering.y; ++i) {
        vec2 at = light.radiance.w * stratified_disk(seed, i, light.filtering.y);
#if SHADOW_SPREAD
        beside_m = spread_place(area, i);
#endif
        dvec3 along = middle + dvec3(right * at.x + up * at.y) - (kIsSun ? dvec3(0.0) : dvec3(beside_m));
        if (!(dot(vec3(along), normal) > 0.0)) continue;
        ++rays;
        lit += int(lit_along(position_ca, beside_m, along, kNoEnd, error_m, receiver));
    }
    return rays > 0 ? float(lit) / float(rays) : 0.0;
}
#endif

#if SHADOW_SHEETS
#include "shadow/filters/exact/classification.glsl"
#include "shadow/filters/exact/classify_soft.glsl"

// Returns the map's verdict. `error_m`: how far position_ca may be off the surface.
int certainty(vec3 position_ca, float error_m, uvec2 receiver) {
    return soft_verdict(sheet_place(position_ca, error_m), position_ca, receiver_casts(receiver));
}

float uncertain_reach(vec3 position_ca, float error_m) { return kNoEnd; }
#else
#include "shadow/filters/exact/no_map.glsl"
#endif
#include "shadow/filters/exact/classify_or_trace.glsl"
