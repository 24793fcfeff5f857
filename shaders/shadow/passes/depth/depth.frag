// Opaque casters: the rasteriser's depth is all there is. Masked ones drop what is cut out.
// TRIANGLES: and which triangle of which instance is shown (shadow/filters/triangles/mesh_walk.glsl).
#ifdef TRIANGLES
layout(location = 0) out uvec2 triangle_out;
layout(location = 0) flat in uvec2 fragment_item;   // instance, first triangle of the draw
void write_triangle() { triangle_out = uvec2(fragment_item.x, fragment_item.y + uint(gl_PrimitiveID)); }
#else
void write_triangle() {}
#endif
#ifdef MASKED
#include "common/material.glsl"
in vec2 fragment_uv;
void main() {
    if (cut_out(fragment_uv)) discard;
    write_triangle();
}
#else
void main() { write_triangle(); }
#endif
