// One light over its screen rectangle: visibility times BRDF, added to the picture; or the visibility alone. READ_KEPT: as
// it was when it was last looked up. LEAVE_UNDECIDED: but for pixels that this filter takes long for. SOME_UNLIT: surfaces may be unlit.
#include "lighting/gbuffer/gbuffer_read.glsl"
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/visibility.glsl"
#include "shadow/lookup/shadow_layers.glsl"
#ifdef SHADOW_FOUND
#include "lighting/trace/ray_results.glsl"
#endif
#include "lighting/lights/light_sample.glsl"
#include "lighting/lights/surface_visibility.glsl"
#include "lighting/lights/brdf.glsl"
#include "lighting/post/picture_sum.glsl"
#ifdef READ_KEPT
#include "lighting/lights/visibility_cache.glsl"
#endif
#ifdef WRITE_VISIBILITY
layout(location = 0) out float visibility_out;
#else
layout(location = 0) out vec4 colour_out;
#endif

void main() {
    Surface surface = read_surface(ivec2(gl_FragCoord.xy));
    if (!surface.exists) discard;
    LightSample incoming = light_at(surface.position_ca);
#ifdef READ_KEPT
    float visible = kept_share(ivec2(gl_FragCoord.xy));
#else
    float visible = visible_share(surface, incoming);
#endif
#ifdef LEAVE_UNDECIDED
    if (shadow_undecided) discard;
#endif
#ifdef WRITE_VISIBILITY
    visibility_out = visible;
#else
#ifdef SOME_UNLIT
    if (surface.unlit) visible = 0.0;
#endif
    vec3 reflected = brdf_times_cosine(surface.colour, surface.metallic, surface.roughness, surface.shading_normal,
                                       surface.to_viewer, incoming.to_light);
    colour_out = vec4(visible > 0.0 ? in_picture(visible * incoming.radiance * reflected) : vec3(0.0), 0.0);
#endif
}
