// Tint of the places that each map of a light serves. Where one map fades into the next, the tints mix by their shares.
// Places that no map serves keep their colour.
#include "debug/lookup.glsl"
const float kTint = 0.4;   // opacity of the colour over the picture
vec4 tint = vec4(0.0);

void show_lookup(ShadowPoint point, vec3 normal, float share) {
    int layer = shadow_layer(point);
    tint = mix(tint, is_shown(layer) ? vec4(scale.colours[layer].rgb, 1.0) : vec4(0.0), share);
}

void main() {
    look_up(ivec2(gl_FragCoord.xy));
    colour_out = over_picture(tint, kTint);
}
