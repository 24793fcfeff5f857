// Triangle that a fragment shows: instance, and number among the triangles of all casters.
#include "common/bindings.glsl"
layout(location = kItemVarying) flat in uvec2 fragment_item;   // instance; face in the lowest three bits, first triangle of
                                                               // the draw above

uvec2 shown_triangle() { return uvec2(fragment_item.x, (fragment_item.y >> 3) + uint(gl_PrimitiveID)); }
