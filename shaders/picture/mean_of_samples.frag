// Mean of a picture's samples. The target encodes. TRANSPARENT: alpha is coverage.
#include "common/bindings.glsl"
layout(binding = kFinishedPictureUnit) uniform sampler2D sample_sum;
layout(location = 0) out vec4 colour_out;
#ifdef TRANSPARENT
// C++ twin: SampleRecord in systems/picture/picture_samples.cpp.
layout(std140, binding = kSampleBlock) uniform SampleBlock {
    vec4 samples;   // x: their number
};
#endif

void main() {
    vec4 sum = texelFetch(sample_sum, ivec2(gl_FragCoord.xy), 0);
#ifdef TRANSPARENT
    colour_out = sum / max(samples.x, 1.0);
#else
    colour_out = vec4(sum.rgb / max(sum.a, 1.0), 1.0);
#endif
}
