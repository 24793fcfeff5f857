// What four texels show, in textureGather's order: (-,+) (+,+) (+,-) (-,-). See shadow/caster_triangles.glsl.
struct FourTriangles {
    uvec4 instance, triangle;
};
