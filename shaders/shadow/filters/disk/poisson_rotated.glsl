// First points of a Poisson disk, turned by another angle at each point: bands become noise.
#include "shadow/filters/disk/poisson_disk.glsl"
#include "shadow/filters/disk/noise_seed.glsl"

const float kTurn_rad = 6.283185307;

// Returns the turn's cosine and sine.
vec4 filter_setup(ShadowPoint point) {
    float angle_rad = kTurn_rad * shadow_seed(point).x;
    return vec4(cos(angle_rad), sin(angle_rad), 0.0, 0.0);
}

int filter_taps() { return light.filtering.y; }

vec3 filter_tap(ShadowPoint point, vec4 setup, int i) {
    vec2 at = kDisk[i];
    return vec3(point.spread_texel * vec2(setup.x * at.x - setup.y * at.y, setup.y * at.x + setup.x * at.y), 1.0);
}

#include "shadow/filters/disk/disk_box.glsl"
#include "shadow/filters/pcf/multi_tap.glsl"
