// Square of nearest taps on the texel grid, with equal weights (percentage-closer filtering, Reeves et al. 1987).

vec4 filter_setup(ShadowPoint point) { return vec4(0.0); }

int filter_taps() { return light.filtering.x * light.filtering.x; }

vec3 filter_tap(ShadowPoint point, vec4 setup, int i) {
    float size = float(light.filtering.x);
    float row = floor((float(i) + 0.5) / size);
    float middle = 0.5 * (size - 1.0);
    return vec3(float(i) - row * size - middle, row - middle, 1.0);
}

vec4 filter_box(ShadowPoint point, vec4 setup) {
    float most = 0.5 * (float(light.filtering.x) - 1.0);
    return vec4(-most, -most, most, most);
}

#include "shadow/filters/pcf/multi_tap.glsl"
