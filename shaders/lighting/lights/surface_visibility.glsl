// The fraction of the light that reaches a surface: 0 where it faces away or lies outside range or cone.
#ifdef SHADOW_RAYS
#include "lighting/gbuffer/surface_position_f64.glsl"
#endif
float visible_share(Surface surface, LightSample incoming) {
    if (!incoming.reaches || dot(surface.geometric_normal, incoming.to_light) <= 0.0) return 0.0;
    if (!takes_shadow(surface.shadow_layers)) return 1.0;
#ifdef SHADOW_FOUND
    return found_visibility(ivec2(gl_FragCoord.xy));
#elif defined(SHADOW_RAYS)
    SurfacePlace place = unpacked_place(surface.place);
    return shadow_visibility_at(exact_place(ivec2(gl_FragCoord.xy), place), surface.geometric_normal, receiver_of(place));
#else
    return shadow_visibility(surface.position_ca, surface.geometric_normal, surface.error_m);
#endif
}
