// Light that one light adds to a blended surface, by the same visibility as in the deferred passes.
#define BLENDED_RECEIVER 1
#include "lighting/lights/blended_surface.glsl"
#include "lighting/post/picture_sum.glsl"
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/visibility.glsl"
#include "shadow/lookup/shadow_layers.glsl"
#include "lighting/lights/light_sample.glsl"
#include "lighting/lights/brdf.glsl"
#if SHADOW_RAYS
#include "lighting/gbuffer/surface_position_f64.glsl"
layout(location = kCornerVarying) flat in uint corner;

float visible_share(vec3 geometric, uint triangle) {
    float interpolated_m = -dot(fragment_position_ca, camera.back.xyz);
    dvec3 place_ca = exact_place(ivec2(gl_FragCoord.xy), SurfacePlace(interpolated_m, corner, fragment_item.x, triangle));
    return shadow_visibility_at(place_ca, geometric, uvec2(fragment_item.x, triangle));
}
#else
float visible_share(vec3 geometric, uint triangle) {
    return shadow_visibility(fragment_position_ca, geometric, kRebuiltRelative * length(fragment_position_ca));
}
#endif

void main() {
    BlendedSurface surface = blended_surface();
    LightSample incoming = light_at(fragment_position_ca);
    vec3 added = vec3(0.0);
    if (incoming.reaches && dot(surface.geometric_normal, incoming.to_light) > 0.0) {
        float visible = 1.0;
        if (takes_shadow(received_layers(surface.instance))) visible = visible_share(surface.geometric_normal, surface.triangle);
        added = visible * incoming.radiance *
                brdf_times_cosine(surface.colour.rgb, material.metallic, material.roughness, surface.shading_normal,
                                  unit_or(to_camera(fragment_position_ca), camera.back.xyz), incoming.to_light);
    }
    colour_out = vec4(in_picture(added * surface.colour.a), 0.0);
}
