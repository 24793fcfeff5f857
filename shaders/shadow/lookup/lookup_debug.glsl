// What a lookup tells debug views of itself: SHADOW_SHOWN.
struct LookupFacts {
    vec2 texel_m;           // sides of a texel, across the light at the receiver
    float along_normal_m;   // how far the bias moved the receiver along its normal
    float toward_m;         // and then toward the light, to first order
    float depth_m;          // metres toward the light per unit of depth there
    float nearer;           // 1 / distance of the light; 0: parallel
};

// What a filter whose width varies blurred by in this lookup: half of it, in texels along u and v; below 0: it is fixed.
vec2 blurred_texel = vec2(-1.0);

LookupFacts facts_orthographic(ViewRecord view, Bias bias, float range_m) {
    vec2 texel_m = vec2(view.axis_u.w, view.axis_v.w) * (range_m / view.axis_back.w);   // the share: of a warped map
    return LookupFacts(texel_m, bias.along_normal_m, bias.depth * range_m, range_m, 0.0);
}

// distance_m: of the light; z_m: the same along the view's axis.
LookupFacts facts_perspective(ViewRecord view, Bias bias, float distance_m, float z_m) {
    float depth_m = distance_m * z_m / view.axis_back.w;
    return LookupFacts(vec2(view.axis_u.w, view.axis_v.w) * z_m, bias.along_normal_m, bias.depth * depth_m, depth_m, 1.0 / distance_m);
}

// How far the bias moved the receiver in all.
float offset_m(LookupFacts facts) {
    return facts.along_normal_m + facts.toward_m / (1.0 + max(facts.toward_m * facts.nearer, 0.0));
}
