// Returns an offset in three dimensions, in shares of the spread, as an offset on the map. What points toward the light
// brings the tap nearer to the middle of the face. What points away takes it no farther.
vec2 flattened(ShadowPoint point, vec3 offset) {
    float toward = max(offset.z, 0.0) * point.spread_texel.x * shadow_texel_tan();
    return point.spread_texel * offset.xy / (1.0 + toward);
}

bool is_cube() { return shadow_texel_tan() > 0.0; }
