// C++ twin: MomentRecord in systems/shadow/passes/prefilter_pass.h.
#include "common/bindings.glsl"
layout(std140, binding = kPrefilterBlock) uniform MomentBlock {
    vec4 settings;     // the filter's
    vec4 range;        // Perspective map: x: alpha; y: beta (shadow/lookup/bias/automatic.glsl).
                       // z: nearest distance, metres; w: 1 / (farthest - nearest).
    ivec4 place;       // x: layer or face.
                       // y: texels to each side that are blurred.
                       // z: rows of the scratch texture beyond each border of the map.
                       // w: a bit per face that was drawn.
    vec4 axis_u;       // xyz: axis of a cube's face, as in face_axes()
    vec4 axis_v;
    vec4 axis_back;
    vec4 weights[4];   // from the middle outward
} moment;

float weight(int away) { return moment.weights[away >> 2][away & 3]; }
