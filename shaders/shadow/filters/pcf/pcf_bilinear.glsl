// Mean of a square of hardware 2x2 taps a texel apart, in the fewest fetches. n x n such taps weigh n + 1 texels a
// side, (1 - s) 1 1 ... 1 s. The sampler's own blend gives any two neighbours any weights (Sigg and Hadwiger 2005).

// Returns s along both axes: how far the point lies past the middle of a texel, texels.
vec4 filter_setup(ShadowPoint point) { return vec4(fract(shadow_texel(point) - 0.5), 0.0, 0.0); }

int fetches_a_side() { return (light.filtering.x + 1) / 2; }

int filter_taps() { return fetches_a_side() * fetches_a_side(); }

// Returns offset and weight of fetch j along an axis. The point lies `share` of a texel past a texel's centre there.
vec2 fetch_along(float share, int j) {
    float low = j == 0 ? 1.0 - share : 1.0;
    float high = j == fetches_a_side() - 1 ? share : 1.0;
    return vec2(float(2 * j - light.filtering.x / 2) - share + high / (low + high), low + high);
}

vec3 filter_tap(ShadowPoint point, vec4 setup, int i) {
    int row = int((float(i) + 0.5) / float(fetches_a_side()));
    vec2 u = fetch_along(setup.x, i - row * fetches_a_side());
    vec2 v = fetch_along(setup.y, row);
    return vec3(u.x, v.x, u.y * v.y);
}

vec4 filter_box(ShadowPoint point, vec4 setup) {
    int last = fetches_a_side() - 1;
    return vec4(fetch_along(setup.x, 0).x, fetch_along(setup.y, 0).x, fetch_along(setup.x, last).x, fetch_along(setup.y, last).x);
}

#include "shadow/filters/pcf/multi_tap.glsl"
