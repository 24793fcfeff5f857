// Colour of a vertex, in scenes that have any (COLOURED). It is read as a texel: vertices of other scenes stay as small
// as they are.
#include "common/bindings.glsl"
#ifdef COLOURED
layout(binding = kColourUnit) uniform usamplerBuffer colour_texels;   // per vertex
vec4 vertex_colour() { return uintBitsToFloat(texelFetch(colour_texels, gl_VertexID)); }
#else
vec4 vertex_colour() { return vec4(1.0); }
#endif
