// Triangles that four texels show, in textureGather's order: (-,+) (+,+) (+,-) (-,-). See
// shadow/filters/triangles/mesh_walk.glsl.
struct FourTriangles {
    uvec4 instance, triangle;
};
