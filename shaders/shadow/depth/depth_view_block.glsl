// C++ twin: DepthViewRecord in systems/shadow/types.h.
layout(std140, binding = 0) uniform DepthViewBlock {
    mat4 clip_from_anchor;
    vec4 anchor_high;   // xyz
    vec4 anchor_low;    // xyz
} depth_view;
