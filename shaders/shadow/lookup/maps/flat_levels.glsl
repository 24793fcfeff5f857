// Flat prefiltered maps: reading one level of their mipmaps, or between two.
#include "common/bindings.glsl"
layout(binding = kShadowMapUnit) uniform sampler2DArray shadow_map;

// So many texels beside the point, of one level of its mipmaps or between two.
vec4 shadow_moments_at(ShadowPoint point, vec2 offset_texel, float level) {
    return textureLod(shadow_map, vec3(point.map.xy + offset_texel * point.texel_uv, point.layer), level);
}

// For a lookup of texels within `reach` of it: before all of its plane there.
ShadowPoint before_plane(ShadowPoint point, float reach_texel) {
    point.reference = clamp(point.reference + reach_texel * (abs(point.slope.x) + abs(point.slope.y)), 0.0, 1.0);
    return point;
}
