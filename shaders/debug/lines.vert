// Lines in the world, two vertices each.
#include "common/bindings.glsl"
#include "common/camera_block.glsl"
// C++ twin: LineVertex in systems/debug/lines.h.
struct LineVertex {
    vec4 position_ca;   // from the camera's anchor, metres
    vec4 colour;        // linear
};
layout(std430, binding = kLineBuffer) readonly buffer LineBuffer { LineVertex line_vertices[]; };
flat out vec3 line_colour;

void main() {
    LineVertex vertex = line_vertices[gl_VertexID];
    line_colour = vertex.colour.rgb;
    gl_Position = camera.clip_from_anchor * vec4(vertex.position_ca.xyz, 1.0);
}
