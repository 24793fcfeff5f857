// A vertex's own colour, in scenes that have any (COLOURED). Read as a texel: the others' vertices stay as small as they are.
#include "common/bindings.glsl"
#ifdef COLOURED
layout(binding = kColourUnit) uniform usamplerBuffer colour_texels;   // of each vertex
vec4 vertex_colour() { return uintBitsToFloat(texelFetch(colour_texels, gl_VertexID)); }
#else
vec4 vertex_colour() { return vec4(1.0); }
#endif
