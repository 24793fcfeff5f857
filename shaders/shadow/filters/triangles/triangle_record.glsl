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
