// Flat maps, for filters that read results of comparing.
#include "common/bindings.glsl"
layout(binding = kShadowMapUnit) uniform sampler2DArrayShadow shadow_map;

vec2 shadow_map_size() { return vec2(textureSize(shadow_map, 0).xy); }

// Returns the result of one comparison, `offset_texel` texels beside the receiver.
float shadow_tap(ShadowPoint point, vec2 offset_texel) {
    float reference = point.map.z;
    if (kManualBias) reference = clamp(reference + dot(point.slope, offset_texel), 0.0, 1.0);
    return texture(shadow_map, vec4(point.map.xy + offset_texel * point.texel_uv, point.layer, reference));
}
