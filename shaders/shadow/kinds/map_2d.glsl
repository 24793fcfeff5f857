// What the kinds with flat maps share: one compare tap, `offset_texel` texels away from the receiver.
layout(binding = 4) uniform sampler2DArrayShadow shadow_map;

struct ShadowPoint {
    bool covered;       // false: no map holds this point, it is lit
    vec3 map;           // u, v, biased reference depth
    float layer;
    vec2 texel_uv;
    vec2 spread_texel;  // half-width of a disk of taps
    vec3 position_ca;   // what was asked for
};

float shadow_tap(ShadowPoint point, vec2 offset_texel) {
    return texture(shadow_map, vec4(point.map.xy + offset_texel * point.texel_uv, point.layer, point.map.z));
}

// Where the point lies in the map, in texels from its corner.
vec2 shadow_texel(ShadowPoint point) { return point.map.xy / point.texel_uv; }

// Tangent of a texel's side where directions count (a cube); a flat map does not tell what lies toward the light.
float shadow_texel_tan() { return 0.0; }

// Beyond the far plane depth is negative: not covered. Before the near plane it is clamped onto it.
// Nearer than `margin_texel` to the border a filter would read past it: not covered.
ShadowPoint point_2d(int view, vec4 projected, float bias_depth, float margin_texel) {
    ShadowPoint point;
    point.texel_uv = 1.0 / vec2(textureSize(shadow_map, 0).xy);
    vec3 map = projected.xyz / projected.w;
    vec2 margin = margin_texel * point.texel_uv;
    point.covered = projected.w > 0.0 && map.z >= 0.0 && all(greaterThanEqual(map.xy, margin)) && all(lessThanEqual(map.xy, 1.0 - margin));
    point.map = vec3(map.xy, clamp(map.z + bias_depth, 0.0, 1.0));
    point.layer = light.views[view].numeric.w;
    return point;
}
