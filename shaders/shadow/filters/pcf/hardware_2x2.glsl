// Returns four texels compared and blended by the sampler, in one tap (percentage-closer filtering, Reeves et al.
// 1987).
float shadow_filter(ShadowPoint point) { return shadow_tap(point, vec2(0.0)); }
