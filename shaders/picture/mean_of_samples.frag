// Mean of a picture's samples. The target encodes.
#include "common/bindings.glsl"
layout(binding = kFinishedPictureUnit) uniform sampler2D sample_sum;
layout(location = 0) out vec4 colour_out;

void main() {
    vec4 sum = texelFetch(sample_sum, ivec2(gl_FragCoord.xy), 0);
    colour_out = vec4(sum.rgb / max(sum.a, 1.0), 1.0);
}
