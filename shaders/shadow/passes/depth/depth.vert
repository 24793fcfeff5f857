// Depth of casters as a light sees them. Requires neither normals nor shading.
// LAYERED: one pass for all faces of a cube; each draw item names its face. This stage sends it there
// (LAYER_BY_VERTEX), or layer.geom does.
// The linker drops outputs that the fragment shader does not read.
#ifdef LAYER_BY_VERTEX
#extension GL_ARB_shader_viewport_layer_array : require
void send_to(uint face) { gl_Layer = int(face); }
#else
void send_to(uint face) {}
#endif
#include "common/bindings.glsl"
#include "common/instances.glsl"
#include "common/vertex_colour.glsl"
#include "shadow/passes/depth/depth_view_block.glsl"
layout(location = kPositionAttribute) in vec3 position_ms;
layout(location = kUvAttribute) in vec2 uv;
layout(location = kDrawItemAttribute) in uvec2 draw_item;   // instance; face (LAYERED) in the lowest three bits, first
                                                            // triangle of the draw above
layout(location = kItemVarying) flat out uvec3 item_out;
layout(location = kUvVarying) out vec2 uv_out;
layout(location = kColourVarying) out vec4 colour_out;

void main() {
    uint face = draw_item.y & 7u;
    DepthView view = depth_view_of(face);
    vec3 position_as = position_from_anchor(instance_record(draw_item.x), position_ms, view.anchor_high.xyz, view.anchor_low.xyz);
    precise vec4 position_cs = view.clip_from_anchor * vec4(position_as, 1.0);
    gl_Position = position_cs;
    uint bits = uint(view.anchor_high.w);
    item_out = uvec3(draw_item.x << bits, draw_item.y, (1u << bits) - 1u);
    uv_out = uv;
    colour_out = vertex_colour();
    send_to(face);
}
