// Line that a pixel's centre sees, in the camera's axes.
#include "common/camera_block.glsl"

// Line from `origin` on, one metre along the view for each unit of `along`.
struct PixelLine {
    vec3 origin, along;
};

// Returns a pixel's device coordinates. They are rounded once, by a share of themselves, near the picture's middle as
// well: what is divided is a whole number.
vec2 pixel_ndc(ivec2 pixel) {
    return (2.0 * vec2(pixel) + 1.0 - camera.unproject.zw) / camera.unproject.zw + camera.lens.xy;
}

PixelLine pixel_line(ivec2 pixel) {
    vec2 ndc = pixel_ndc(pixel);
    vec3 lateral = camera.right.xyz * (ndc.x * camera.right.w) + camera.up.xyz * (ndc.y * camera.up.w);
    return camera.back.w > 0.5 ? PixelLine(lateral, -camera.back.xyz) : PixelLine(vec3(0.0), lateral - camera.back.xyz);
}

// Returns the line's direction with all that is added as if it had one sign: rounding is a share of it.
vec3 pixel_line_sums(ivec2 pixel) {
    vec2 ndc = abs(pixel_ndc(pixel));
    vec3 lateral = abs(camera.right.xyz) * (ndc.x * camera.right.w) + abs(camera.up.xyz) * (ndc.y * camera.up.w);
    return camera.back.w > 0.5 ? lateral : lateral + abs(camera.back.xyz);
}

// Returns the position that a pixel sees at this distance along the view, from the camera's anchor, metres.
vec3 position_seen_at(ivec2 pixel, float distance_m) {
    PixelLine line = pixel_line(pixel);
    return line.origin + line.along * distance_m;
}
