// The casters' triangles, read as texels for the reason in common/instance_buffer.glsl. bench/glsl_on_cpu/overrides has
// a twin of this file for text that is compiled as C++.
#include "common/bindings.glsl"
#include "shadow/filters/triangles/triangle_record.glsl"
layout(binding = kCasterTriangleUnit) uniform usamplerBuffer caster_triangles;    // a corner and what lies across each

CasterTriangle caster_triangle(uint triangle) {
    int texel = 3 * int(triangle);
    uvec4 a = texelFetch(caster_triangles, texel), b = texelFetch(caster_triangles, texel + 1), c = texelFetch(caster_triangles, texel + 2);
    return CasterTriangle(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w);
}
