// Triangle that a fragment shows: instance, and number among the triangles of all casters.
#include "common/bindings.glsl"
layout(location = kItemVarying) flat in uvec2 fragment_item;   // instance; face in the lowest three bits, first triangle of
                                                               // the draw above

const uint kUnknownTriangles = 0xffffffffu >> 3;   // twin: DepthDraws::kNoTriangle
uvec2 shown_triangle() {
    uint first = fragment_item.y >> 3;
    return uvec2(fragment_item.x, first == kUnknownTriangles ? 0xffffffffu : first + uint(gl_PrimitiveID));
}
