// Tint of what each map of a light serves; where one fades into the next, by their shares. What no map serves stays as
// it is.
#include "debug/lookup.glsl"
const float kTint = 0.4;   // of what is shown; the rest is the picture
vec4 tint = vec4(0.0);

void show_lookup(ShadowPoint point, vec3 normal, float share) {
    int layer = shadow_layer(point);
    tint = mix(tint, is_shown(layer) ? vec4(scale.colours[layer].rgb, 1.0) : vec4(0.0), share);
}

void main() {
    look_up(ivec2(gl_FragCoord.xy));
    colour_out = over_picture(tint, kTint);
}
