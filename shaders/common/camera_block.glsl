// C++ twin: CameraRecord in systems/shadow/frame/lighting_inputs.h.
#include "common/bindings.glsl"
layout(std140, binding = kCameraBlock) uniform CameraBlock {
    mat4 clip_from_anchor;   // anchor: the camera's position; axes: the world's
    vec4 anchor_high;        // xyz
    vec4 anchor_low;         // xyz
    vec4 right;              // xyz: axis; w: tangent of the half angle in x (orthographic: half width, metres)
    vec4 up;                 // xyz: axis; w: the same in y
    vec4 back;               // xyz: axis; w: 1 for orthographic
    vec4 unproject;          // x, y: see view_distance(); zw: size of the viewport, pixels
    vec4 lens;               // xy: where the view's axis leaves the middle, in half extents. zw: error of imported depths
                             // beyond that of rebuilding (lighting/gbuffer/gbuffer_read.glsl). 0 for own pictures
} camera;
