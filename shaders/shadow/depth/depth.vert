// Depth of casters as a light sees them. Needs neither normals nor colours.
#include "shared/instances.glsl"
#include "shadow/depth/depth_view_block.glsl"
layout(location = 0) in vec3 position_ms;
layout(location = 3) in uvec2 draw_item;   // instance, first triangle
#ifdef MASKED
layout(location = 2) in vec2 uv;
out vec2 fragment_uv;
#endif

void main() {
    vec3 position_as = position_from_anchor(instances[draw_item.x], position_ms, depth_view.anchor_high.xyz,
                                            depth_view.anchor_low.xyz);
    gl_Position = depth_view.clip_from_anchor * vec4(position_as, 1.0);
#ifdef MASKED
    fragment_uv = uv;
#endif
}
