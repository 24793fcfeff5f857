// The rays of a list, one after the other, row by row.
#include "lighting/surface_targets.glsl"
#include "row.glsl"
#include "shadow/light_block.glsl"
#include "lighting/ray_list.glsl"
layout(location = 0) out float answer_out;

void main() {
    uint place = uint(gl_FragCoord.y) * uint(camera.unproject.z) + uint(gl_FragCoord.x);
    if (place >= ray_count) discard;
    uint pixel = listed_pixels[place];
    Surface surface = read_surface(ivec2(pixel & 0xffffu, pixel >> 16));
    float reach = uncertain_reach(surface.seen_ca, surface.geometric_normal, surface.seen_error_m);
    answer_out = shadow_ray(reach, surface.place_ca, surface.geometric_normal, 0.0, surface.triangle);
}
