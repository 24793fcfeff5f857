// 4 x 4 x 4 taps around the point, as LearnOpenGL's cubes are filtered. On a flat map the third dimension shows
// nothing: 4 x 4 taps.
#include "shadow/filters/disk/cube_offsets.glsl"

vec4 filter_setup(ShadowPoint point) { return vec4(0.0); }

int filter_taps() { return is_cube() ? 64 : 16; }

vec3 filter_tap(ShadowPoint point, vec4 setup, int i) {
    vec3 at = vec3(float(i & 3), float(i >> 2 & 3), float(i >> 4));
    return vec3(flattened(point, at * (2.0 / 3.0) - 1.0), 1.0);
}

#include "shadow/filters/disk/disk_box.glsl"
#include "shadow/filters/pcf/multi_tap.glsl"
