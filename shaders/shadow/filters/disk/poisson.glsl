// First points of a Poisson disk, equal weights.
#include "shadow/filters/disk/poisson_disk.glsl"

vec4 filter_setup(ShadowPoint point) { return vec4(0.0); }

int filter_taps() { return light.filtering.y; }

vec3 filter_tap(ShadowPoint point, vec4 setup, int i) { return vec3(point.spread_texel * kDisk[i], 1.0); }

#include "shadow/filters/disk/disk_box.glsl"
#include "shadow/filters/pcf/multi_tap.glsl"
