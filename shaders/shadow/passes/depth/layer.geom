// Sends each triangle to the face of the cube that its draw item names.
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(location = 0) flat in uvec2 item_in[];
layout(location = 1) in vec2 uv_in[];
layout(location = 2) in vec4 colour_in[];
layout(location = 0) flat out uvec2 item_out;
layout(location = 1) out vec2 uv_out;
layout(location = 2) out vec4 colour_out;

void main() {
    for (int i = 0; i < 3; ++i) {
        gl_Layer = int(item_in[0].y & 7u);
        gl_Position = gl_in[i].gl_Position;
        gl_PrimitiveID = gl_PrimitiveIDIn;
        item_out = item_in[0];
        uv_out = uv_in[i];
        colour_out = colour_in[i];
        EmitVertex();
    }
    EndPrimitive();
}
