// Facts of a lookup that debug views show.
struct LookupFacts {
    vec2 texel_m;           // sides of a texel across the light at the receiver, metres
    float along_normal_m;   // distance that the bias moved the receiver along its normal, metres
    float toward_m;         // distance that it then moved it toward the light, to first order, metres
    float depth_m;          // metres toward the light per unit of depth there
    float nearer;           // 1 / distance of the light; 0: parallel light
};

// Half-width by which a filter of varying width blurred in this lookup, texels along u and v. Below 0: the width is
// fixed.
vec2 blurred_texel = vec2(-1.0);

LookupFacts facts_orthographic(ViewRecord view, Bias bias, float range_m) {
    vec2 texel_m = vec2(view.axis_u.w, view.axis_v.w) * (range_m / view.axis_back.w);   // the quotient is 1 but of a warped map
    return LookupFacts(texel_m, bias.along_normal_m, bias.depth * range_m, range_m, 0.0);
}

// Returns the facts of a lookup in a perspective map. distance_m: of the light; z_m: its part along the view's axis.
LookupFacts facts_perspective(ViewRecord view, Bias bias, float distance_m, float z_m) {
    float depth_m = distance_m * z_m / view.axis_back.w;
    return LookupFacts(vec2(view.axis_u.w, view.axis_v.w) * z_m, bias.along_normal_m, bias.depth * depth_m, depth_m, 1.0 / distance_m);
}

// Returns how far the bias moved the receiver in all, metres.
float offset_m(LookupFacts facts) {
    return facts.along_normal_m + facts.toward_m / (1.0 + max(facts.toward_m * facts.nearer, 0.0));
}
