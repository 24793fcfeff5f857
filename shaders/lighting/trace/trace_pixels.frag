// Rays of a list, one after the other.
#include "lighting/gbuffer/gbuffer_read.glsl"
#include "lighting/gbuffer/surface_position.glsl"
#include "lighting/gbuffer/surface_position_f64.glsl"
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
#include "lighting/trace/ray_list_layout.glsl"
#include "lighting/trace/ray_list.glsl"
layout(location = 0) out float answer_out;

void main() {
    int listed = list_place(ivec2(gl_FragCoord.xy), list_width(ivec2(camera.unproject.zw)));
    if (listed >= int(ray_count)) discard;
    ivec2 pixel = ivec2(listed_pixels[listed] & 0xffffu, listed_pixels[listed] >> 16);
    Surface surface = read_surface(pixel);
    SurfacePlace place = unpacked_place(surface.place);
    SeenPlace seen = seen_place(pixel, place);
    float reach = uncertain_reach(seen.position_ca, seen.error_m);
    answer_out = shadow_ray(reach, exact_place(pixel, place), surface.geometric_normal, 0.0, receiver_of(place));
}
