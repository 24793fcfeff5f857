// C++ twin: DepthViewRecord in systems/shadow/frame/types.h.
#ifdef LAYERED
struct DepthView {
    mat4 clip_from_anchor;
    vec4 anchor_high;   // xyz
    vec4 anchor_low;    // xyz
};
layout(std140, binding = 0) uniform DepthViewsBlock { DepthView depth_views[6]; };   // by face
#else
layout(std140, binding = 0) uniform DepthViewBlock {
    mat4 clip_from_anchor;
    vec4 anchor_high;   // xyz; w: texels along an edge of the map (shadow/exact)
    vec4 anchor_low;    // xyz; w: layer of the map
} depth_view;
#endif
