// Distance by which the bias moves the receiver before it is compared, on the scale of colours.
#include "debug/lookup.glsl"
const float kStrength = 0.9;   // opacity of the colour over the picture
vec4 seen = vec4(0.0);

void show_lookup(ShadowPoint point, vec3 normal, float share) {
    point = compared_point(point, normal);
    seen = mix(seen, is_shown(shadow_layer(point)) ? on_scale(offset_m(point.facts)) : vec4(0.0), share);
}

void main() {
    look_up(ivec2(gl_FragCoord.xy));
    colour_out = over_picture(seen, kStrength);
}
