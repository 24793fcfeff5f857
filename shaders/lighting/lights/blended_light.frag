// Light that one light adds to a blended surface, by the same visibility as in the deferred passes.
#define BLENDED_RECEIVER 1
#include "lighting/lights/blended_surface.glsl"
#include "lighting/post/picture_sum.glsl"
#include "lighting/lights/forward_visibility.glsl"
#include "lighting/lights/reflected_light.glsl"

void main() {
    BlendedSurface surface = blended_surface();
    LightSample incoming = light_at(fragment_position_ca);
    vec3 added = vec3(0.0);
    if (!is_unreached(surface.geometric_normal, incoming))
        added = arriving(surface, incoming) *
                reflected_share(incoming, surface.colour.rgb, material.metallic, material.roughness, surface.shading_normal,
                                unit_or(to_camera(fragment_position_ca), camera.back.xyz));
    colour_out = vec4(in_picture(added * surface.colour.a), 0.0);
}
