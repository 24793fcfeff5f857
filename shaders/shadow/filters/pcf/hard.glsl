// Returns a hard shadow: one tap, at the nearest texel.
float shadow_filter(ShadowPoint point) { return shadow_tap(point, vec2(0.0)); }
