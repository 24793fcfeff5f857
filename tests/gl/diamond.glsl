// [file]
// Weighs the five nearest taps: the receiver's texel counts as much as the four beside it.
vec4 filter_setup(ShadowPoint point) { return vec4(0.0); }

int filter_taps() { return 5; }

vec3 filter_tap(ShadowPoint point, vec4 setup, int i) {
    if (i == 0) return vec3(0.0, 0.0, 4.0);
    float side = (i & 1) == 0 ? -1.0 : 1.0;
    return i < 3 ? vec3(side, 0.0, 1.0) : vec3(0.0, side, 1.0);
}

vec4 filter_box(ShadowPoint point, vec4 setup) { return vec4(-1.0, -1.0, 1.0, 1.0); }

#include "shadow/filters/pcf/multi_tap.glsl"
// [file]
