// Flat prefiltered maps: reading one level of their mipmaps, or between two.
#include "common/bindings.glsl"
layout(binding = kShadowMapUnit) uniform sampler2DArray shadow_map;

vec2 shadow_map_size() { return vec2(textureSize(shadow_map, 0).xy); }

// Returns the moments some texels beside the point, of one level of the mipmaps or between two.
vec4 shadow_moments_at(ShadowPoint point, vec2 offset_texel, float level) {
    return textureLod(shadow_map, vec3(point.map.xy + offset_texel * point.texel_uv, point.layer), level);
}

// Moves the reference before all of the receiver's plane within `reach_texel`, for a lookup of texels that far.
ShadowPoint before_plane(ShadowPoint point, float reach_texel) {
    point.reference = clamp(point.reference + reach_texel * (abs(point.slope.x) + abs(point.slope.y)), 0.0, 1.0);
    return point;
}
