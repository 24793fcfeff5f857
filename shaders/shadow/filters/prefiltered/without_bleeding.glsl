// Visibility by a prefiltered map's moments.
#ifndef SHADOW_SOFT_MOMENTS
float lit_by_moments(ShadowPoint point) { return moments_lit(shadow_moments(point), shadow_share(point), light.moments); }
#endif

// Returns the light without the share that counts as dark. Two casters, one behind the other, are taken for one
// between: what is lit only a little may be dark.
float shadow_filter(ShadowPoint point) {
    float lit = lit_by_moments(point);
    float bleeding = light.moment_sampling.x;
    return clamp((lit - bleeding) / (1.0 - bleeding), 0.0, 1.0);
}
