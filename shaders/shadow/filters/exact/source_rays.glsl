// Rays to places of an area light. Requires shadow/filters/exact/shadow_ray.glsl and the files for its seeds.
#include "shadow/lookup/source_place.glsl"

// Returns the i-th of `count` places of the source: source_place().
vec2 ray_place(vec2 seed, int i, int count) {
    if (!kSquarePlaces) return stratified_disk(seed, i, count);
    return 2.0 * vec2((float(i) + seed.x) / float(count), fract(seed.y + kGolden * float(i))) - 1.0;
}

// Returns the share of the light that rays find, each by what falls on the surface along it. It ignores `reach`, which
// bounds the ray to the light's middle alone. SHADOW_SPREAD: each ray begins at a place of its own.
float shadow_ray(float reach, dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    dvec3 middle = way_to_light(position_ca);
    vec2 seed = cell_seed(vec3(position_ca));
    float lit = 0.0, all = 0.0;
    vec3 beside_m = vec3(0.0);
#if SHADOW_SPREAD
    PixelArea area = pixel_area(vec3(position_ca), normal);
#endif
    int count = light.filtering.y;
    // A round more where all places are below the surface: to the source's highest.
    for (int i = 0; i < count || (i == count && all == 0.0); ++i) {
#if SHADOW_SPREAD
        beside_m = i < count ? spread_place(area, i) : vec3(0.0);
#endif
        dvec3 from_here = middle - dvec3(beside_m);
        AreaSource source = source_seen(vec3(from_here));
        SourcePlace place = source_place(source, ray_place(seed, min(i, count - 1), count));
        if (i == count) place.offset_m = source_top(source, normal);
        dvec3 along = (from_here + dvec3(place.offset_m)) * double(kBeforeSource);
        float weight = i < count ? place.weight * dot(normalize(vec3(along)), normal) : 1.0;
        if (!(weight > 0.0)) continue;
        all += weight;
        lit += weight * lit_along(position_ca, beside_m, along, kNoEnd, error_m, receiver);
    }
    return all > 0.0 ? min(lit / all, 1.0) : 0.0;
}
