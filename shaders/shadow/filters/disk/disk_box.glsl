// Returns the box around a disk of taps.
vec4 filter_box(ShadowPoint point, vec4 setup) { return vec4(-point.spread_texel, point.spread_texel); }
