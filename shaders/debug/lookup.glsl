// Light's own lookup at every surface that makes one, for debug views. A view defines show_lookup(), which gets each
// lookup and its share in what the surface gets: 1, then the share of what it fades into.
#include "common/bindings.glsl"
#include "lighting/gbuffer/gbuffer_read.glsl"
#include "row.glsl"
#include "shadow/lookup/light_block.glsl"
void show_lookup(ShadowPoint point, vec3 normal, float share);
#include "shadow/lookup/visibility.glsl"
#include "shadow/lookup/shadow_layers.glsl"
#include "lighting/lights/light_sample.glsl"
#include "lighting/lights/surface_visibility.glsl"
// C++ twin: ShownScale in systems/debug/shown_scale.h.
layout(std140, binding = kShownScaleBlock) uniform ShownScale {
    vec4 colours[8];   // rgb: linear; w: the length it stands for, metres
    ivec4 options;     // x: the only map to be shown, below 0: all; y: number of colours that stand for lengths
} scale;
layout(location = 0) out vec4 colour_out;

bool is_shown(int layer) { return layer >= 0 && (scale.options.x < 0 || scale.options.x == layer); }

// Returns the colour of a length, between two of the scale by its logarithm; opaque.
vec4 on_scale(float length_m) {
    vec3 colour = scale.colours[0].rgb;
    for (int i = 1; i < scale.options.y; ++i) {
        float least = scale.colours[i - 1].w;
        float share = log(max(length_m, least) / least) / log(scale.colours[i].w / least);
        colour = mix(colour, scale.colours[i].rgb, clamp(share, 0.0, 1.0));
    }
    return vec4(colour, 1.0);
}

// Returns what is drawn over the picture. `seen`: colour times coverage, and coverage. The rest of `strength` is the
// picture.
vec4 over_picture(vec4 seen, float strength) { return vec4(seen.rgb / max(seen.a, 1e-6), strength * seen.a); }

// Looks up as the light's own pass does, without the colour.
void look_up(ivec2 pixel) {
    Surface surface = read_surface(pixel);
    if (surface.exists) visible_share(surface, light_at(surface.position_ca));
}
