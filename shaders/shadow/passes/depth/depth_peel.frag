// Depth of the casters behind the nearest: all but the triangles that another map shows. It follows Everitt 2001,
// "Interactive order-independent transparency", by triangles instead of depths: no offset decides what is behind.
#include "common/bindings.glsl"
layout(binding = kNearestTriangleUnit) uniform usampler2DArray nearest_triangles;
#include "shadow/passes/depth/shown_triangle.glsl"

void main() {
    ivec3 texel = ivec3(ivec2(gl_FragCoord.xy), 0);   // one layer serves all views, one after the other
    if (texelFetch(nearest_triangles, texel, 0).xy == shown_triangle()) discard;
}
