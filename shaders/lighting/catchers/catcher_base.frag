// Shadow catcher without any light's pass: its depth, and ambient light, which casters do not take.
#include "lighting/lights/blended_surface.glsl"
#include "lighting/lights/ambient.glsl"
#include "lighting/catchers/caught_sum.glsl"

void main() {
    if (cut_out(fragment_uv)) discard;
    colour_out = caught_sum(0.0, luminance(ambient_irradiance(blended_surface().shading_normal)));
}
