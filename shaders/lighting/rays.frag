// The rays of a list, one after the other, row by row.
#include "lighting/surface_targets.glsl"
#include "row.glsl"
#include "shadow/light_block.glsl"
#include "lighting/ray_list.glsl"
layout(location = 0) out float answer_out;

void main() {
    uint place = uint(gl_FragCoord.y) * uint(camera.unproject.z) + uint(gl_FragCoord.x);
    if (place >= ray_count) discard;
    ListedRay listed = listed_rays[place];
    Surface surface = read_surface(ivec2(listed.pixel & 0xffffu, listed.pixel >> 16));
    answer_out = shadow_ray(listed.reach, surface.place_ca, surface.geometric_normal, 0.0, surface.triangle);
}
