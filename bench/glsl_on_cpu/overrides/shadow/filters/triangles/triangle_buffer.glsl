// Takes the place of the shaders' own file where their text is compiled as C++ (shader_structs.inc): the casters in double,
// which no texel holds.
#include "shadow/filters/triangles/triangle_record.glsl"
StorageBuffer<CasterTriangle> caster_triangles;

CasterTriangle caster_triangle(uint triangle) { return caster_triangles[triangle]; }
