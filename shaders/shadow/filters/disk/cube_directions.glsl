// Twenty taps toward the corners and the edges' middles of a cube around the point. On a flat map taps that differ only
// toward the light are one tap, which weighs as many.
#include "shadow/filters/disk/cube_offsets.glsl"

vec4 filter_setup(ShadowPoint point) { return vec4(0.0); }

int filter_taps() { return is_cube() ? 20 : 8; }

// Returns -1 or 1 by a bit of i.
float side(int i, int bit) { return float((i >> bit & 1) * 2 - 1); }

// Returns a tap on a flat map, and its weight. The first four lie at corners of a square, the next four at the middles
// of its sides.
vec3 flat_direction(int i) {
    if (i < 4) return vec3(side(i, 0), side(i, 1), 3.0);
    if (i < 6) return vec3(side(i, 0), 0.0, 2.0);
    return vec3(0.0, side(i, 0), 2.0);
}

// Returns a tap's direction: eight corners, then the edges along z, y and x.
vec3 direction(int i) {
    if (i < 8) return vec3(side(i, 0), side(i, 1), side(i, 2));
    if (i < 12) return vec3(side(i, 0), side(i, 1), 0.0);
    if (i < 16) return vec3(side(i, 0), 0.0, side(i, 1));
    return vec3(0.0, side(i, 0), side(i, 1));
}

vec3 filter_tap(ShadowPoint point, vec4 setup, int i) {
    if (is_cube()) return vec3(flattened(point, direction(i)), 1.0);
    vec3 at = flat_direction(i);
    return vec3(point.spread_texel * at.xy, at.z);
}

#include "shadow/filters/disk/disk_box.glsl"
#include "shadow/filters/pcf/multi_tap.glsl"
