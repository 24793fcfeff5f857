// A blended surface, drawn forward after all others: first what it lets through and its ambient light,
// then one pass per light that adds. The same visibility include as the deferred passes. UNLIT: it is shown as it is, by no light.
#include "common/instances.glsl"
#include "common/camera_block.glsl"
#include "common/material.glsl"
#include "common/float_rounding.glsl"
#include "lighting/gbuffer/triangle_normals.glsl"
#include "lighting/lights/ambient.glsl"
#include "lighting/post/picture_sum.glsl"
#ifdef UNLIT
#include "lighting/post/tone_curve.glsl"
#endif
in vec3 fragment_position_ca;
in vec3 fragment_normal;
in vec2 fragment_uv;
flat in uvec2 fragment_item;
layout(location = 0) out vec4 colour_out;
#ifdef LIGHT_PASS
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/visibility.glsl"
#include "shadow/lookup/shadow_layers.glsl"
#include "lighting/lights/light_sample.glsl"
#include "lighting/lights/brdf.glsl"
#endif
#ifdef SHADOW_RAYS
#include "lighting/gbuffer/surface_position_f64.glsl"
flat in uint corner;
#endif

#ifdef LIGHT_PASS
float visible_share(vec3 geometric, uint triangle) {
#ifdef SHADOW_RAYS
    float interpolated_m = -dot(fragment_position_ca, camera.back.xyz);
    dvec3 place_ca = exact_place(ivec2(gl_FragCoord.xy), SurfacePlace(interpolated_m, corner, fragment_item.x, triangle));
    return shadow_visibility_at(place_ca, geometric, uvec2(fragment_item.x, triangle));
#else
    return shadow_visibility(fragment_position_ca, geometric, kRebuiltRelative * length(fragment_position_ca));
#endif
}
#endif

void main() {
    vec4 colour = material_colour(fragment_uv);
    InstanceRecord instance = instance_record(fragment_item.x);
    uint triangle = fragment_item.y + uint(gl_PrimitiveID);
    vec3 geometric = geometric_normal(instance, triangle, fragment_position_ca);
    vec3 shading = shading_normal(fragment_normal, geometric);
#ifdef LIGHT_PASS
    LightSample incoming = light_at(fragment_position_ca);
    vec3 added = vec3(0.0);
    if (incoming.reaches && dot(geometric, incoming.to_light) > 0.0) {
        float visible = 1.0;
        if (takes_shadow(received_layers(instance))) visible = visible_share(geometric, triangle);
        added = visible * incoming.radiance *
                brdf_times_cosine(colour.rgb, material.metallic, material.roughness, shading,
                                  unit_or(to_camera(fragment_position_ca), camera.back.xyz), incoming.to_light);
    }
    colour_out = vec4(in_picture(added * colour.a), 0.0);
#elif defined(UNLIT)
    colour_out = vec4(ambient.ground.w * exposed_as(colour.rgb), colour.a);
#else
    colour_out = vec4(in_picture(ambient_light(colour.rgb, shading) + material.emissive.rgb * ambient.sky.w), colour.a);
#endif
}
