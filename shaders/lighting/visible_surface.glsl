// The fraction of the light that reaches a surface: 0 where it faces away or lies outside range or cone.
float visible_share(Surface surface, LightSample incoming) {
    if (!incoming.reaches || dot(surface.geometric_normal, incoming.to_light) <= 0.0) return 0.0;
    if (!takes_shadow(surface.shadow_layers)) return 1.0;
#ifdef SHADOW_FOUND
    return found_visibility(ivec2(gl_FragCoord.xy));
#elif defined(SHADOW_RAYS)
    return shadow_visibility_at(surface.place_ca, surface.geometric_normal, surface.triangle);
#else
    return shadow_visibility(surface.position_ca, surface.geometric_normal, surface.error_m);
#endif
}
