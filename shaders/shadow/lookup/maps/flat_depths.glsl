// Flat maps, for filters that read depths.
#include "common/bindings.glsl"
layout(binding = kShadowMapUnit) uniform sampler2DArray shadow_map;

vec2 shadow_map_size() { return vec2(textureSize(shadow_map, 0).xy); }

// Returns where the point lies in the map, texels; the middle of the first is at 1/2.
vec2 shadow_place(ShadowPoint point) { return point.map.xy / point.texel_uv; }

float shadow_depth(ShadowPoint point, vec2 middle) {
    return textureLod(shadow_map, vec3(middle * point.texel_uv, point.layer), 0.0).x;
}

// Returns the depths of the four texels around a corner between texels, in textureGather's order.
vec4 shadow_depths(ShadowPoint point, vec2 corner) {
    return textureGather(shadow_map, vec3(corner * point.texel_uv, point.layer));
}
