// Other points of the disk at each receiver, one in each of as many rings of equal area as there are taps, in steps of the
// golden angle; the seed moves them within their ring, and turns all.
#include "shadow/filters/seed.glsl"

const float kTurn_rad = 6.283185307;
const float kGolden = 0.6180339887;

vec4 filter_setup(ShadowPoint point) { return vec4(shadow_seed(point), 0.0, 0.0); }

int filter_taps() { return light.filtering.y; }

vec3 filter_tap(ShadowPoint point, vec4 setup, int i) {
    float in_ring = fract(setup.x + kGolden * float(i * i));
    float radius = sqrt((float(i) + in_ring) / float(filter_taps()));
    float angle_rad = kTurn_rad * fract(setup.y + kGolden * float(i));
    return vec3(point.spread_texel * (radius * vec2(cos(angle_rad), sin(angle_rad))), 1.0);
}

#include "shadow/filters/disk_box.glsl"
#include "shadow/filters/multi_tap.glsl"
