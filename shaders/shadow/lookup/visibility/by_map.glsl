// Visibility of a light by its map.

// Returns the reach that the bias serves, texels. 0: the filter reads depths and compares on the receiver's own plane,
// so that the offset covers snapping and rounding alone.
float shadow_bias_texel() { return kReadsDepths ? 0.0 : SHADOW_REACH_TEXEL; }

// Moves the point as its taps are compared.
ShadowPoint compared_point(ShadowPoint point, vec3 normal) {
    if (kManualBias && point.covered && compares_on_plane()) point = on_receiver_plane(point, normal);
    return point;
}

float filtered(ShadowPoint point, vec3 normal, float error_m) {
    if (!may_be_dark(point)) return 1.0;
    point = compared_point(point, normal);
    if (kReadsDepths) point.slope = shadow_slope(point, normal);
    point.normal = normal;
    point.error_m = error_m;
    return shadow_filter(point);
}

float shadow_visibility(vec3 position_ca, vec3 normal, float error_m) {
    float reach_texel = shadow_bias_texel();
    float visible = 1.0, share = 1.0;
    int lookup = 0;
    // Two rounds where the first lookup fades into a second one. It is a loop, because software devices run both sides
    // of an `if`.
    do {
        ShadowPoint point = shadow_point(lookup, position_ca, normal, error_m, reach_texel);
        float found = filtered(point, normal, error_m);
        if (kFades && lookup > 0 && !shadow_fades_into(point)) share = 0.0;
#ifdef SHADOW_SHOWN
        show_lookup(point, normal, share);
#endif
        visible = kFades ? mix(visible, found, share) : found;
        share = kFades && lookup == 0 ? shadow_fade_share(point, reach_texel) : 0.0;
        ++lookup;
    } while (share > 0.0);
    return visible;
}
