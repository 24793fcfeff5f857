// Other points of the disk at each receiver, a point in each of as many rings of equal area as there are taps.
#include "shadow/filters/disk/noise_seed.glsl"
#include "shadow/filters/disk/stratified_disk.glsl"

vec4 filter_setup(ShadowPoint point) { return vec4(shadow_seed(point), 0.0, 0.0); }

int filter_taps() { return light.filtering.y; }

vec3 filter_tap(ShadowPoint point, vec4 setup, int i) {
    return vec3(point.spread_texel * stratified_disk(vec2(setup.x, setup.y), i, filter_taps()), 1.0);
}

#include "shadow/filters/disk/disk_box.glsl"
#include "shadow/filters/pcf/multi_tap.glsl"
