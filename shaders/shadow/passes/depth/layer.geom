// Sends each triangle to the face of the cube that its draw item names.
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(location = 0) flat in uvec2 vertex_item[];
#ifdef MASKED
in vec2 vertex_uv[];
out vec2 fragment_uv;
#endif
#ifdef COLOURED
in vec4 vertex_colour_out[];
out vec4 fragment_colour;
#endif
#ifdef TRIANGLES
layout(location = 0) flat out uvec2 fragment_item;
#endif

void main() {
    for (int i = 0; i < 3; ++i) {
        gl_Layer = int(vertex_item[0].y & 7u);
        gl_Position = gl_in[i].gl_Position;
#ifdef MASKED
        fragment_uv = vertex_uv[i];
#endif
#ifdef COLOURED
        fragment_colour = vertex_colour_out[i];
#endif
#ifdef TRIANGLES
        fragment_item = uvec2(vertex_item[0].x, vertex_item[0].y >> 3);
        gl_PrimitiveID = gl_PrimitiveIDIn;
#endif
        EmitVertex();
    }
    EndPrimitive();
}
