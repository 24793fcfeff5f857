// visibility(position, normal, error): the fraction of `light` that reaches a point, for any renderer.
// Include it after row.glsl, which names one kind and one filter; SHADOW_REACH_TEXEL is the filter's footprint.
//   position_ca   from the camera's anchor, metres
//   normal        geometric normal, unit, facing the viewer
//   error_m       how far position_ca may be off the true surface
float shadow_visibility(vec3 position_ca, vec3 normal, float error_m) {
#ifdef SHADOWED
    ShadowPoint point = shadow_point(position_ca, normal, error_m, SHADOW_REACH_TEXEL);
    float visible = point.covered ? shadow_filter(point) : 1.0;
#ifdef SHADOW_FADES
    // A second lookup that the first one fades into: shadow_fade_share() of it.
    float share = shadow_fade_share();
    if (share > 0.0) {
        ShadowPoint other = shadow_fade_point(position_ca, normal, error_m, SHADOW_REACH_TEXEL);
        visible = mix(visible, other.covered ? shadow_filter(other) : 1.0, share);
    }
#endif
    return visible;
#else
    return 1.0;
#endif
}
