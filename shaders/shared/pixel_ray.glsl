// Where a pixel's centre looks, in the camera's space of axes.
#include "shared/camera_block.glsl"

// What it sees at this distance along the view.
vec3 position_seen_at(ivec2 pixel, float distance_m) {
    vec2 ndc = (vec2(pixel) + 0.5) / camera.unproject.zw * 2.0 - 1.0;
    bool orthographic = camera.back.w > 0.5;
    vec3 lateral = camera.right.xyz * (ndc.x * camera.right.w) + camera.up.xyz * (ndc.y * camera.up.w);
    return orthographic ? lateral - camera.back.xyz * distance_m : (lateral - camera.back.xyz) * distance_m;
}
