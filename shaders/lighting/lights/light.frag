// One light over its screen rectangle: visibility times BRDF, added to the picture. VISIBLE_SHARE names the file that
// gives the visibility: looked up, found before, or kept from an earlier frame.
// SHADOW_TINT names the file that gives its colour behind translucent casters.
// LEAVE_UNDECIDED: leaves out pixels for which the filter takes long. SOME_UNLIT: surfaces may be unlit.
#include "lighting/gbuffer/gbuffer_read.glsl"
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/visibility.glsl"
#include VISIBLE_SHARE
#include SHADOW_TINT
#include "shadow/lookup/shadow_layers.glsl"
#include "lighting/lights/reflected_light.glsl"
#include "lighting/post/picture_sum.glsl"
layout(location = 0) out vec4 colour_out;

void main() {
    Surface surface = read_surface(ivec2(gl_FragCoord.xy));
    if (!surface.exists) discard;
    LightSample incoming = light_at(surface.position_ca);
    float visible = visible_share(surface, incoming);
#ifdef LEAVE_UNDECIDED
    if (shadow_undecided) discard;
#endif
#ifdef SOME_UNLIT
    if (surface.unlit) visible = 0.0;
#endif
    vec3 arrives = visible * incoming.radiance;
    if (kTinted && visible > 0.0 && takes_shadow(surface.shadow_layers))
        arrives *= shadow_tint(surface.position_ca, surface.geometric_normal, surface.error_m);
    vec3 reflected = reflected_share(incoming, surface.colour, surface.metallic, surface.roughness, surface.shading_normal,
                                     surface.to_viewer);
    colour_out = vec4(visible > 0.0 ? in_picture(arrives * reflected) : vec3(0.0), 0.0);
}
