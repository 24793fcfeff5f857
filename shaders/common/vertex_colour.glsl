// A vertex's own colour, in scenes that have any (COLOURED). Read as a texel: the others' vertices stay as small as they are.
#ifdef COLOURED
layout(binding = 3) uniform usamplerBuffer colour_texels;   // of each vertex; C++ twin of the unit: kColourUnit in gpu_scene.h
vec4 vertex_colour() { return uintBitsToFloat(texelFetch(colour_texels, gl_VertexID)); }
#else
vec4 vertex_colour() { return vec4(1.0); }
#endif
