// Sends each triangle to the face of the cube that its draw item names.
#include "common/bindings.glsl"
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(location = kItemVarying) flat in uvec3 item_in[];
layout(location = kUvVarying) in vec2 uv_in[];
layout(location = kColourVarying) in vec4 colour_in[];
layout(location = kItemVarying) flat out uvec3 item_out;
layout(location = kUvVarying) out vec2 uv_out;
layout(location = kColourVarying) out vec4 colour_out;

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
