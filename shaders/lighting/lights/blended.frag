// Blended surface, drawn forward after all others: what it lets through and what it shows without any light's pass.
// blended_light.frag adds the lights. UNLIT: it is shown as it is, by no light.
#include "lighting/lights/blended_surface.glsl"
#include "lighting/lights/own_light.glsl"

void main() {
    BlendedSurface surface = blended_surface();
    colour_out = vec4(own_light(surface.colour.rgb, surface.shading_normal), surface.colour.a);
}
