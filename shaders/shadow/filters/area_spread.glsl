// Places of a pixel's area on its receiver's plane, at which taps and rays of a source with a size begin.
#include "shadow/passes/prefilter/pixel_footprint.glsl"

// How far the receiver's plane moves as the pixel moves by one, metres. 0: the area is its middle alone.
struct PixelArea { vec3 right, up; };

PixelArea pixel_area(vec3 position_ca, vec3 normal) {
    return PixelArea(step_right(position_ca, normal) * light.low.w, step_up(position_ca, normal) * light.low.w);
}

// Returns the way to the i-th place, metres. Any first ones are spread evenly, and apart from stratified_disk()'s: Roberts,
// "The unreasonable effectiveness of quasirandom sequences" (2018).
vec3 spread_place(PixelArea area, int i) {
    vec2 at = fract(float(i) * vec2(0.7548776662, 0.5698402910) + 0.5) - 0.5;
    return area.right * at.x + area.up * at.y;
}
