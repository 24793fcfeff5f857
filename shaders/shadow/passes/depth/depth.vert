// Depth of casters as a light sees them. Needs neither normals nor colours.
// LAYERED: one pass for all faces of a cube; each draw item names its face. This stage sends it there (LAYER_BY_VERTEX),
// or layer.geom does.
// TRIANGLES: each draw item names the first triangle of its draw, too.
#ifdef LAYER_BY_VERTEX
#extension GL_ARB_shader_viewport_layer_array : require
#endif
#include "common/instances.glsl"
#include "shadow/passes/depth/depth_view_block.glsl"
layout(location = 0) in vec3 position_ms;
layout(location = 3) in uvec2 draw_item;   // instance; face (LAYERED) in the lowest three bits, first triangle above
#if defined(LAYERED) && !defined(LAYER_BY_VERTEX)
layout(location = 0) flat out uvec2 vertex_item;
#define UV_OUT vertex_uv
#define COLOUR_OUT vertex_colour_out
#else
#define UV_OUT fragment_uv
#define COLOUR_OUT fragment_colour
#ifdef TRIANGLES
layout(location = 0) flat out uvec2 fragment_item;
#endif
#endif
#ifdef MASKED
layout(location = 2) in vec2 uv;
out vec2 UV_OUT;
#endif
#ifdef COLOURED
#include "common/vertex_colour.glsl"
out vec4 COLOUR_OUT;
#endif

void main() {
    uint face = draw_item.y & 7u;
#ifdef LAYERED
    DepthView depth_view = depth_views[face];
#endif
    vec3 position_as = position_from_anchor(instance_record(draw_item.x), position_ms, depth_view.anchor_high.xyz,
                                            depth_view.anchor_low.xyz);
    precise vec4 position_cs = depth_view.clip_from_anchor * vec4(position_as, 1.0);
    gl_Position = position_cs;
#ifdef MASKED
    UV_OUT = uv;
#endif
#ifdef COLOURED
    COLOUR_OUT = vertex_colour();
#endif
#ifdef LAYER_BY_VERTEX
    gl_Layer = int(face);
#elif defined(LAYERED)
    vertex_item = draw_item;
#endif
#if defined(TRIANGLES) && (!defined(LAYERED) || defined(LAYER_BY_VERTEX))
    fragment_item = uvec2(draw_item.x, draw_item.y >> 3);
#endif
}
