// What debug views of a light's lookups share: the light's own lookup, at every surface that makes one. A view defines
// show_lookup(), which is told of each lookup and of its share in what the surface gets: 1, then what it fades into.
#include "lighting/surface_targets.glsl"
#include "row.glsl"
#include "shadow/light_block.glsl"
void show_lookup(ShadowPoint point, float share);
#include "shadow/visibility.glsl"
#include "shadow/layers.glsl"
#include "lighting/light_at.glsl"
#include "lighting/visible_surface.glsl"
// C++ twin: ShownScale in systems/debug/shown_scale.h.
layout(std140, binding = 5) uniform ShownScale {
    vec4 colours[8];   // rgb: linear; w: the value it stands for
} scale;
layout(location = 0) out vec4 colour_out;

// Looks up as the light's own pass does, but for the colour.
void look_up(ivec2 pixel) {
    Surface surface = read_surface(pixel);
    if (surface.exists) visible_share(surface, light_at(surface.position_ca));
}
