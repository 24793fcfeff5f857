// Light that one light adds to a blended surface, by the same visibility as in the deferred passes.
#define BLENDED_RECEIVER 1
#include "lighting/lights/blended_surface.glsl"
#include "lighting/post/picture_sum.glsl"
#include "lighting/lights/forward_visibility.glsl"
#include "lighting/lights/brdf.glsl"

void main() {
    BlendedSurface surface = blended_surface();
    LightSample incoming = light_at(fragment_position_ca);
    vec3 added = vec3(0.0);
    if (incoming.reaches && dot(surface.geometric_normal, incoming.to_light) > 0.0)
        added = arriving(surface, incoming) *
                brdf_times_cosine(surface.colour.rgb, material.metallic, material.roughness, surface.shading_normal,
                                  unit_or(to_camera(fragment_position_ca), camera.back.xyz), incoming.to_light);
    colour_out = vec4(in_picture(added * surface.colour.a), 0.0);
}
