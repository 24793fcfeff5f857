// Colour of one light behind its translucent casters. SHADOW_TINT: as in light.frag.
#include "lighting/gbuffer/gbuffer_read.glsl"
#include "shadow/lookup/light_block.glsl"
#include SHADOW_TINT
#include "shadow/lookup/shadow_layers.glsl"
layout(location = 0) out vec4 tint_out;

void main() {
    Surface surface = read_surface(ivec2(gl_FragCoord.xy));
    if (!surface.exists) discard;
    vec3 tint = takes_shadow(surface.shadow_layers) ? shadow_tint(surface.position_ca, surface.geometric_normal, surface.error_m) : vec3(1.0);
    tint_out = vec4(tint, 1.0);
}
