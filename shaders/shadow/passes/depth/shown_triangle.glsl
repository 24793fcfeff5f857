// Triangle that a fragment shows: instance, and number among the triangles of all casters.
#include "common/bindings.glsl"
layout(location = kItemVarying) flat in uvec3 fragment_item;   // instance, above the mask; face in the lowest three bits,
                                                               // first triangle of the draw above; mask of a number

const uint kUnknownTriangles = 0xffffffffu >> 3;   // twin: DepthDraws::kNoTriangle
// Returns both in the first number, and the triangle alone in the second (shadow/filters/triangles/gathered_ids.glsl).
uvec2 shown_triangle() {
    uint first = fragment_item.y >> 3;
    uint triangle = first == kUnknownTriangles ? 0xffffffffu : first + uint(gl_PrimitiveID);
    return uvec2(fragment_item.x | triangle & fragment_item.z, triangle);
}
