// Direction and strength of one light at a point, as KHR_lights_punctual defines them.
#include "shadow/lookup/row_flags.glsl"
#if LIGHT_AREA
#include "shadow/lookup/source_place.glsl"
#endif

struct LightSample {
    vec3 to_light;     // unit
    vec3 radiance;     // lux at a surface facing the light, times ambient.sky.w; 0 outside range and cone. Area light: nits
    bool reaches;
#if LIGHT_AREA
    AreaSource source;
#endif
};

#if LIGHT_AREA
// Returns the share of the light that its range leaves.
float range_share(float distance_m, float range_m) {
    float x = distance_m / range_m;
    return range_m > 0.0 ? clamp(1.0 - x * x * x * x, 0.0, 1.0) : 1.0;
}

LightSample light_at(vec3 position_ca) {
    LightSample s;
    s.source = source_seen(light.position.xyz - position_ca);
    float distance_m = length(s.source.middle_m), range_m = light.position.w;
    s.to_light = s.source.middle_m / max(distance_m, 1e-30);
    s.reaches = distance_m > 0.0 && (range_m == 0.0 || distance_m <= range_m) && is_shone_on(s.source);
    s.radiance = s.reaches ? light.radiance.rgb * range_share(distance_m, range_m) : vec3(0.0);
    return s;
}

// Returns whether a surface faces away from all of the source that its filter sees, or lies outside the light's range.
bool is_unreached(vec3 geometric_normal, LightSample incoming) {
    const float kInPlane = 1e-5;   // share of the distance up to which a middle counts as in the surface's plane
    vec3 middle_m = incoming.source.middle_m;
    float highest_m = dot(geometric_normal, middle_m);
    highest_m += kOfMiddle ? -kInPlane * length(middle_m) : source_extent(incoming.source, geometric_normal);
    return !incoming.reaches || highest_m <= 0.0;
}
#else
LightSample light_at(vec3 position_ca) {
    if (kIsSun) return LightSample(light.to_light.xyz, light.radiance.rgb, true);
    LightSample s;
    vec3 offset = light.position.xyz - position_ca;
    float distance_m = length(offset);
    s.to_light = offset / max(distance_m, 1e-30);
    float range_m = light.position.w;
    s.reaches = distance_m > 0.0 && (range_m == 0.0 || distance_m <= range_m);
    float falloff = 1.0 / max(distance_m * distance_m, 1e-30);
    if (range_m > 0.0) {
        float x = distance_m / range_m;
        falloff *= clamp(1.0 - x * x * x * x, 0.0, 1.0);
    }
    if (kIsSpot) {
        float cosine = dot(s.to_light, light.to_light.xyz);
        float edge = clamp((cosine - light.cone.x) * light.cone.y, 0.0, 1.0);
        s.reaches = s.reaches && cosine > light.cone.x;
        falloff *= edge * edge;
    }
    const float kMost_lx = 1e30;   // what a surface reflects of it is finite
    s.radiance = s.reaches ? min(light.radiance.rgb * falloff, vec3(kMost_lx)) : vec3(0.0);
    return s;
}

// Returns whether a surface faces away from the light, or lies outside its range or cone.
bool is_unreached(vec3 geometric_normal, LightSample incoming) {
    return !incoming.reaches || dot(geometric_normal, incoming.to_light) <= 0.0;
}
#endif
