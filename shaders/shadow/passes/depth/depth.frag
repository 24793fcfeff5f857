// Depth of casters, which the rasteriser writes. Masked casters drop what is cut out. TRIANGLES: writes the triangle
// that is shown, too, and its instance (shadow/filters/triangles/mesh_walk.glsl).
#include "common/bindings.glsl"
#ifdef TRIANGLES
#include "shadow/passes/depth/shown_triangle.glsl"
layout(location = 0) out uvec2 triangle_out;
void write_triangle() { triangle_out = shown_triangle(); }
#else
void write_triangle() {}
#endif
#ifdef MASKED
#include "common/material.glsl"
layout(location = kUvVarying) in vec2 fragment_uv;
void main() {
    if (cut_out(fragment_uv)) discard;
    write_triangle();
}
#else
void main() { write_triangle(); }
#endif
