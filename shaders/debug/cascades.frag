// Tints what each map of a light serves; where one fades into the next, by their shares. What no map serves stays as it is.
#include "debug/lookup.glsl"
const float kTint = 0.4;   // of what is shown; the rest is the picture
vec4 tint = vec4(0.0);     // a: whether any map serves

void show_lookup(ShadowPoint point, float share) {
    int layer = shadow_layer(point);
    tint = mix(tint, layer < 0 ? vec4(0.0) : vec4(scale.colours[layer].rgb, 1.0), share);
}

void main() {
    look_up(ivec2(gl_FragCoord.xy));
    colour_out = vec4(tint.rgb / max(tint.a, 1e-6), kTint * tint.a);
}
