// Returns how far a filter's taps may lie from the receiver, texels along u and v. texel_m: sides of a texel there,
// metres.
// light.spread: x: texels; y: metres, 0: x counts; z: growth per metre of view distance; w: most texels.
vec2 shadow_spread(vec2 texel_m, float view_distance_m) {
    vec2 spread = light.spread.y > 0.0 ? light.spread.y / texel_m : vec2(light.spread.x);
    return min(spread * (1.0 + view_distance_m * light.spread.z), light.spread.w);
}

// Returns how far from a point texels are read, where the bias serves texels within reach_texel.
float read_texel(float reach_texel) { return kReadsTaps ? reach_texel : max(reach_texel, SHADOW_REACH_TEXEL); }
