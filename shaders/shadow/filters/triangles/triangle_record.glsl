// C++ twin: CasterTriangle in systems/extract/caster_triangles.h. `across`: the triangle beyond the edge that starts at
// a corner. A masked triangle has kMaskedTriangle, the word of its mask and the word of its texture coordinates.
struct CasterTriangle {
    vec3 a;
    uint across_ab;
    vec3 b;
    uint across_bc;
    vec3 c;
    uint across_ca;
};
