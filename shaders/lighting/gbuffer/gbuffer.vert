// Surfaces as the camera sees them. The linker drops outputs that the fragment shader does not read.
// INVARIANT_POSITION: several programs draw the same depths.
#include "common/bindings.glsl"
#include "common/instances.glsl"
#include "common/camera_block.glsl"
#include "common/vertex_colour.glsl"
layout(location = kPositionAttribute) in vec3 position_ms;
layout(location = kNormalAttribute) in vec3 normal_ms;
layout(location = kUvAttribute) in vec2 uv;
layout(location = kDrawItemAttribute) in uvec2 draw_item;   // instance, first triangle
layout(location = kColourVarying) out vec4 fragment_colour;
layout(location = kPositionVarying) out vec3 fragment_position_ca;
layout(location = kNormalVarying) out vec3 fragment_normal;
layout(location = kUvVarying) out vec2 fragment_uv;
layout(location = kItemVarying) flat out uvec2 fragment_item;
layout(location = kCornerVarying) flat out uint corner;   // a vertex of the triangle, for lighting/gbuffer/visible_triangle.glsl
#ifdef INVARIANT_POSITION
invariant gl_Position;
#endif

void main() {
    InstanceRecord instance = instance_record(draw_item.x);
    vec3 position_ca = position_from_anchor(instance, position_ms, camera.anchor_high.xyz, camera.anchor_low.xyz);
    fragment_position_ca = position_ca;
    fragment_normal = normal_from_model(instance, normal_ms);
    fragment_uv = uv;
    fragment_colour = vertex_colour();
    fragment_item = draw_item;
    corner = uint(gl_VertexID);
    gl_Position = camera.clip_from_anchor * vec4(position_ca, 1.0);
}
