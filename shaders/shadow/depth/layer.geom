// Sends each triangle to the face of the cube that its draw item names.
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(location = 0) flat in uint vertex_face[];
#ifdef MASKED
in vec2 vertex_uv[];
out vec2 fragment_uv;
#endif

void main() {
    for (int i = 0; i < 3; ++i) {
        gl_Layer = int(vertex_face[0]);
        gl_Position = gl_in[i].gl_Position;
#ifdef MASKED
        fragment_uv = vertex_uv[i];
#endif
        EmitVertex();
    }
    EndPrimitive();
}
