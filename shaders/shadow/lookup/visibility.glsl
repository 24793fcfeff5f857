// visibility(position, normal, error): the fraction of `light` that reaches a point, for any renderer.
// Include it after row.glsl, which names one kind and one filter; SHADOW_REACH_TEXEL is the filter's footprint, and
// SHADOW_DEPTHS is defined if it reads depths, SHADOW_MANUAL_BIAS if the light's bias is not the automatic one,
// SHADOW_MOMENTS if it reads a prefiltered map, SHADOW_FOOTPRINT if that has mipmaps or anisotropy (then row.glsl brings
// CameraBlock), SHADOW_TRIANGLES if it reads which triangles texels show (then CameraBlock and common/instances.glsl), SHADOW_RAYS if it
// asks the casters' triangles by rays (then those as well, and SHADOW_SHEETS if a map says where rays are needed). RAY_MASKS, with one of
// these two, if some casters are masked.
// LEAVE_UNDECIDED: the filter says `shadow_undecided` where it would take long.
//   position_ca   from the camera's anchor, metres
//   normal        geometric normal, unit, facing the viewer
//   error_m       how far position_ca may be off the true surface
#if defined(SHADOWED) && !defined(SHADOW_RAYS)
#ifdef SHADOW_MOMENTS
#ifndef SHADOW_SOFT_MOMENTS
float lit_by_moments(ShadowPoint point) { return moments_lit(shadow_moments(point), shadow_share(point), light.moments); }
#endif

// What is lit only a little may be dark: two casters, one behind the other, are taken for one between. It counts as dark.
float shadow_filter(ShadowPoint point) {
    float lit = lit_by_moments(point);
    float bleeding = light.moment_sampling.x;
    return clamp((lit - bleeding) / (1.0 - bleeding), 0.0, 1.0);
}
#endif

// As its taps are compared.
ShadowPoint compared_point(ShadowPoint point, vec3 normal) {
#ifdef SHADOW_MANUAL_BIAS
    if (point.covered && compares_on_plane()) point = on_receiver_plane(point, normal);
#endif
    return point;
}

#ifdef SHADOW_DEPTHS
// Compares on the receiver's own plane: of the offset, only what snapping and rounding need is left.
float shadow_bias_texel() { return 0.0; }
float filtered(ShadowPoint point, vec3 normal, float error_m) {
    if (!may_be_dark(point)) return 1.0;
    point = compared_point(point, normal);
    point.slope = shadow_slope(point, normal);
#ifdef SHADOW_TRIANGLES
    point.normal = normal;
    point.error_m = error_along_view_m(point.position_ca, normal, error_m);
#endif
    return shadow_filter(point);
}
#else
float shadow_bias_texel() { return SHADOW_REACH_TEXEL; }
float filtered(ShadowPoint point, vec3 normal, float error_m) {
#ifdef SHADOW_FOOTPRINT
    point.normal = normal;
#endif
    return may_be_dark(point) ? shadow_filter(compared_point(point, normal)) : 1.0;
}
#endif
#endif

#ifdef SHADOW_RAYS
// Of a place that is exactly on a triangle of an instance.
float shadow_visibility_at(dvec3 position_ca, vec3 normal, uvec2 receiver) { return shadow_traced(position_ca, normal, 0.0, receiver); }
#endif

float shadow_visibility(vec3 position_ca, vec3 normal, float error_m) {
#ifdef SHADOW_RAYS
    return shadow_traced(dvec3(position_ca), normal, error_m, kNoReceiver);
#elif defined(SHADOWED)
    float reach_texel = shadow_bias_texel();
    float visible = 1.0, share = 1.0;
    int lookup = 0;
    // Where the first lookup fades into a second one, two rounds. A loop, because software devices run both sides of an `if`.
    do {
        ShadowPoint point = shadow_point(lookup, position_ca, normal, error_m, reach_texel);
        float found = filtered(point, normal, error_m);
#ifdef SHADOW_FADES
        if (lookup > 0 && !shadow_fades_into(point)) share = 0.0;
#endif
#ifdef SHADOW_SHOWN
        show_lookup(point, normal, share);
#endif
#ifdef SHADOW_FADES
        visible = mix(visible, found, share);
        share = lookup == 0 ? shadow_fade_share(point, reach_texel) : 0.0;
#else
        visible = found;
        share = 0.0;
#endif
        ++lookup;
    } while (share > 0.0);
    return visible;
#else
    return 1.0;
#endif
}
