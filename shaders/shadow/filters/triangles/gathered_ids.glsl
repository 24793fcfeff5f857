// Triangles that four texels show, in textureGather's order: (-,+) (+,+) (+,-) (-,-). See
// shadow/filters/triangles/mesh_walk.glsl.
struct FourTriangles {
    uvec4 instance, triangle;
};

// Returns instance and triangle of a texel. `bits`: of the triangle's number, in the first of the texel's numbers and
// below the instance's; all set: no triangle. 0: the texel has two numbers. C++ twin: TriangleReferences in
// systems/shadow/frame/triangle_references.h.
uvec2 unpacked_triangle(uvec2 numbers, int bits) {
    uint none = (1u << bits) - 1u, triangle = numbers.x & none;
    if (bits == 0) return numbers;
    return uvec2(numbers.x >> bits, triangle == none ? 0xffffffffu : triangle);
}

FourTriangles unpacked_triangles(uvec4 first, uvec4 second, int bits) {
    FourTriangles shown;
    shown.instance = shown.triangle = uvec4(0u);
    for (int i = 0; i < 4; ++i) {
        uvec2 one = unpacked_triangle(uvec2(first[i], second[i]), bits);
        shown.instance[i] = one.x;
        shown.triangle[i] = one.y;
    }
    return shown;
}
