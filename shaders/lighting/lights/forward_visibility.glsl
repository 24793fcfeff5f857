// Fraction of a light that reaches a surface that is drawn forward, by the same lookup as in the deferred passes.
// Include it after BLENDED_RECEIVER and lighting/lights/blended_surface.glsl.
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/visibility.glsl"
#include SHADOW_TINT
#include "shadow/lookup/shadow_layers.glsl"
#include "lighting/lights/light_sample.glsl"
#if SHADOW_RAYS
#include "lighting/gbuffer/surface_position_f64.glsl"
layout(location = kCornerVarying) flat in uint corner;

float looked_up_share(vec3 geometric, uint triangle) {
    float interpolated_m = -dot(fragment_position_ca, camera.back.xyz);
    dvec3 place_ca = exact_place(ivec2(gl_FragCoord.xy), SurfacePlace(interpolated_m, corner, fragment_item.x, triangle));
    return shadow_visibility_at(place_ca, geometric, uvec2(fragment_item.x, triangle));
}
#else
float looked_up_share(vec3 geometric, uint triangle) {
    return shadow_visibility(fragment_position_ca, geometric, kRebuiltRelative * length(fragment_position_ca));
}
#endif

// Returns the share for a surface that the light reaches.
float visible_share(BlendedSurface surface) {
    if (!takes_shadow(received_layers(surface.instance))) return 1.0;
    return looked_up_share(surface.geometric_normal, surface.triangle);
}

// Returns the light that reaches it: the visible share, in the colour that translucent casters let through.
vec3 arriving(BlendedSurface surface, LightSample incoming) {
    vec3 arrives = visible_share(surface) * incoming.radiance;
    if (kTinted && takes_shadow(received_layers(surface.instance)))
        arrives *= shadow_tint(fragment_position_ca, surface.geometric_normal, kRebuiltRelative * length(fragment_position_ca));
    return arrives;
}
