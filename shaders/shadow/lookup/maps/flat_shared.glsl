// Flat maps of any light, among the layers of shared arrays: read where one program looks up all lights
// (systems/lookup/lookup_glsl.h). That text has the functions shared_depth(), shared_depths() and shared_ids(), and the
// light's map_edge_px. SHADOW_LINEAR_TAPS: 1 where the sampler would blend four results of comparing.
#include "shadow/filters/triangles/gathered_ids.glsl"

vec2 shadow_map_size() { return vec2(map_edge_px); }

// Returns where the point lies in the map, texels; the middle of the first is at 1/2.
vec2 shadow_place(ShadowPoint point) { return point.map.xy / point.texel_uv; }

float shadow_depth(ShadowPoint point, vec2 middle) { return shared_depth(vec3(middle * point.texel_uv, point.layer)); }

// Returns the depths of the four texels around a corner between texels, in textureGather's order.
vec4 shadow_depths(ShadowPoint point, vec2 corner) { return shared_depths(vec3(corner * point.texel_uv, point.layer)); }

// Returns the result of one comparison, `offset_texel` texels beside the receiver.
float shadow_tap(ShadowPoint point, vec2 offset_texel) {
    float reference = clamp(point.map.z + dot(point.slope, offset_texel), 0.0, 1.0);
    vec2 place = point.map.xy / point.texel_uv + offset_texel;
#if SHADOW_LINEAR_TAPS
    vec2 corner = floor(place - 0.5) + 1.0, share = place - 0.5 - floor(place - 0.5);
    vec4 lit = vec4(greaterThanEqual(vec4(reference), shadow_depths(point, corner)));
    return mix(mix(lit.w, lit.z, share.x), mix(lit.x, lit.y, share.x), share.y);
#else
    return reference >= shadow_depth(point, place) ? 1.0 : 0.0;
#endif
}

// Returns what the four texels around a corner show.
FourTriangles shadow_triangles_around(ShadowPoint point, vec2 corner) {
    return shared_ids(vec3(corner * point.texel_uv, point.layer));
}

// Returns the instance and the triangle that a texel shows.
uvec2 shadow_triangle_at(ShadowPoint point, vec2 middle) { return shared_id(vec3(middle * point.texel_uv, point.layer)); }

// Returns the sides of a texel: metres, or tangents from a lamp.
vec2 shadow_texel_sides(ShadowPoint point) { return vec2(light.views[point.view].axis_u.w, light.views[point.view].axis_v.w); }
