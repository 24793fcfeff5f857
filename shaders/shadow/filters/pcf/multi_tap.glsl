// Returns the weighted mean of a filter's taps. Early bailing (light.filtering.z) first compares the corners of the
// taps' box, and its middle. A straight edge that parts the taps parts the corners, too. A thin caster across the
// middle is seen. A filter that includes this file defines before:
// - vec4 filter_setup(ShadowPoint point): values that all taps share, passed to the other functions;
// - int filter_taps(): number of taps;
// - vec3 filter_tap(ShadowPoint point, vec4 setup, int i): xy: offset, texels; z: weight, above 0;
// - vec4 filter_box(ShadowPoint point, vec4 setup): xy: least, zw: greatest offsets, texels.
float shadow_filter(ShadowPoint point) {
    vec4 setup = filter_setup(point);
    if (light.filtering.z != 0) {
        vec4 box = filter_box(point, setup);
        float five = shadow_tap(point, box.xy) + shadow_tap(point, vec2(box.z, box.y)) +
                     shadow_tap(point, vec2(box.x, box.w)) + shadow_tap(point, box.zw) +
                     shadow_tap(point, 0.5 * (box.xy + box.zw));
        if (five == 0.0) return 0.0;
        if (five == 5.0) return 1.0;
    }
    float sum = 0.0;
    float weights = 0.0;
    int i = 0;
    do {
        vec3 tap = filter_tap(point, setup, i);
        sum += tap.z * shadow_tap(point, tap.xy);
        weights += tap.z;
    } while (++i < filter_taps());
    return sum / weights;
}
