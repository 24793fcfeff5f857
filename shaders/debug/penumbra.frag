// Width by which the filter blurs the edge of a shadow, across the light at the receiver, on the scale of colours. A
// filter of varying width shows the width that it found. Where it found nothing to blur, nothing is shown.
#include "debug/lookup.glsl"
const float kStrength = 0.9;   // opacity of the colour over the picture
vec4 seen = vec4(0.0);

void show_lookup(ShadowPoint point, vec3 normal, float share) {
    vec2 half_texel = blurred_texel.x < 0.0 ? SHADOW_REACH_TEXEL + point.spread_texel : blurred_texel;
    vec2 width_m = 2.0 * half_texel * point.facts.texel_m;
    bool any = is_shown(shadow_layer(point)) && half_texel.x > 0.0;
    seen = mix(seen, any ? on_scale(max(width_m.x, width_m.y)) : vec4(0.0), share);
}

void main() {
    look_up(ivec2(gl_FragCoord.xy));
    colour_out = over_picture(seen, kStrength);
}
