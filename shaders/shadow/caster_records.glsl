// The casters' triangles and instances, read as texels: software devices find four numbers of a texel at once, those of a storage
// buffer one by one. bench/in_double has a twin of this file, for what is compiled as C++.
// C++ twin: CasterTriangle in systems/extract/caster_triangles.h. `across`: the triangle beyond the edge that starts at a
// corner; of a masked one kMaskedTriangle, and the words of its mask and of its texture coordinates.
struct CasterTriangle {
    vec3 a;
    uint across_ab;
    vec3 b;
    uint across_bc;
    vec3 c;
    uint across_ca;
};
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
