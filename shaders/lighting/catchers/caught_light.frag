// One light on a shadow catcher: what falls of it, and what casters take.
#define BLENDED_RECEIVER 1
#include "lighting/lights/blended_surface.glsl"
#include "lighting/lights/forward_visibility.glsl"
#include "lighting/catchers/caught_sum.glsl"

void main() {
    if (cut_out(fragment_uv)) discard;
    BlendedSurface surface = blended_surface();
    LightSample incoming = light_at(fragment_position_ca);
    colour_out = vec4(0.0);
    if (incoming.reaches && dot(surface.geometric_normal, incoming.to_light) > 0.0) {
        float cosine = max(dot(surface.shading_normal, incoming.to_light), 0.0);
        float falls = luminance(incoming.radiance) * cosine;
        if (kTinted)
            colour_out = caught_sum(falls - luminance(arriving(surface, incoming)) * cosine, falls);
        else
            colour_out = caught_sum((1.0 - visible_share(surface)) * falls, falls);
    }
}
