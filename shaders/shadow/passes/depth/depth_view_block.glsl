// C++ twin: DepthViewRecord in systems/shadow/frame/pass_inputs.h.
#include "common/bindings.glsl"
struct DepthView {
    mat4 clip_from_anchor;
    vec4 anchor_high;   // xyz; w: texels along an edge of the map (shaders/shadow/passes/bounds), or bits of a triangle's
                        // number in the map's triangles (shown_triangle.glsl)
    vec4 anchor_low;    // xyz; w: layer of the map
};
#ifdef LAYERED
layout(std140, binding = kDepthViewBlock) uniform DepthViewsBlock { DepthView depth_views[6]; };   // per face
DepthView depth_view_of(uint face) { return depth_views[face]; }
#else
layout(std140, binding = kDepthViewBlock) uniform DepthViewBlock {
    mat4 clip_from_anchor;
    vec4 anchor_high, anchor_low;
} depth_view;
DepthView depth_view_of(uint face) { return DepthView(depth_view.clip_from_anchor, depth_view.anchor_high, depth_view.anchor_low); }
#endif
