// One light on a shadow catcher: what falls of it, and what casters take.
#define BLENDED_RECEIVER 1
#include "lighting/lights/blended_surface.glsl"
#include "lighting/lights/forward_visibility.glsl"
#include "lighting/lights/reflected_light.glsl"
#include "lighting/catchers/caught_sum.glsl"

void main() {
    if (cut_out(fragment_uv)) discard;
    BlendedSurface surface = blended_surface();
    LightSample incoming = light_at(fragment_position_ca);
    colour_out = vec4(0.0);
    if (!is_unreached(surface.geometric_normal, incoming)) {
        float share = falling_share(incoming, surface.shading_normal), falls = luminance(incoming.radiance) * share;
        if (kTinted)
            colour_out = caught_sum(falls - luminance(arriving(surface, incoming)) * share, falls);
        else
            colour_out = caught_sum((1.0 - visible_share(surface)) * falls, falls);
    }
}
