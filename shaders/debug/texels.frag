// Texels that serve a pixel, as a chequerboard over the picture, in the map's colour. Where they are too small on
// screen to be distinguished, their mean is shown.
#include "debug/lookup.glsl"
const float kStrength = 0.5;                              // opacity of the colour over the picture
const float kPlain_texel = 0.5, kClear_texel = 0.25;      // texels per pixel: the mean alone, the full contrast
const float kDark = 0.25;
int layer = -1;
vec2 place = vec2(0.0);   // texels

// Keeps the first lookup. What it fades into is not shown: two grids at once show neither.
void show_lookup(ShadowPoint point, vec3 normal, float share) {
    if (share < 1.0) return;
    layer = shadow_layer(point);
    place = shadow_texel(point);
}

void main() {
    look_up(ivec2(gl_FragCoord.xy));
    vec2 per_pixel = fwidth(place);
    float clear = clamp((kPlain_texel - max(per_pixel.x, per_pixel.y)) / (kPlain_texel - kClear_texel), 0.0, 1.0);
    vec2 cell = floor(place);
    bool light_cell = mod(cell.x + cell.y, 2.0) < 1.0;
    float brightness = mix(0.5 * (1.0 + kDark), light_cell ? 1.0 : kDark, clear);
    colour_out = is_shown(layer) ? vec4(brightness * scale.colours[layer].rgb, kStrength) : vec4(0.0);
}
