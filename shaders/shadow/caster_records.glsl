// The casters' triangles and instances, read as texels: software devices find four numbers of a texel at once, those of a storage
// buffer one by one. bench/in_double has a twin of this file, for what is compiled as C++.
#include "shadow/caster_triangle.glsl"
layout(binding = 9) uniform usamplerBuffer caster_triangles;    // a corner and what lies across each
layout(binding = 14) uniform usamplerBuffer caster_instances;   // four of an InstanceRecord each

CasterTriangle caster_triangle(uint triangle) {
    int texel = 3 * int(triangle);
    uvec4 a = texelFetch(caster_triangles, texel), b = texelFetch(caster_triangles, texel + 1), c = texelFetch(caster_triangles, texel + 2);
    return CasterTriangle(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w);
}

InstanceRecord caster_instance(uint instance) {
    int texel = 4 * int(instance);
    return InstanceRecord(uintBitsToFloat(texelFetch(caster_instances, texel)), uintBitsToFloat(texelFetch(caster_instances, texel + 1)),
                          uintBitsToFloat(texelFetch(caster_instances, texel + 2)), uintBitsToFloat(texelFetch(caster_instances, texel + 3)));
}
