// Fraction of the light that reaches a surface. 0: it faces away or lies outside range or cone.
#include "shadow/lookup/shadow_layers.glsl"
#include "lighting/lights/light_sample.glsl"
#if SHADOW_RAYS
#include "lighting/gbuffer/surface_position_f64.glsl"

float looked_up_share(Surface surface) {
    SurfacePlace place = unpacked_place(surface.place);
    return shadow_visibility_at(exact_place(ivec2(gl_FragCoord.xy), place), surface.geometric_normal, receiver_of(place));
}
#else
float looked_up_share(Surface surface) { return shadow_visibility(surface.position_ca, surface.geometric_normal, surface.error_m); }
#endif

float visible_share(Surface surface, LightSample incoming) {
    if (is_unreached(surface.geometric_normal, incoming)) return 0.0;
    if (!takes_shadow(surface.shadow_layers)) return 1.0;
    return looked_up_share(surface);
}
