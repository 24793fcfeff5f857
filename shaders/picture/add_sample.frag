// Adds a picture to the sum of its samples. The texture decodes: light is added. TRANSPARENT: alpha is coverage.
#include "common/bindings.glsl"
layout(binding = kFinishedPictureUnit) uniform sampler2D picture;
layout(location = 0) out vec4 sum_out;   // alpha: number of samples, or the sum of their coverage

void main() {
    sum_out = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
#ifndef TRANSPARENT
    sum_out.a = 1.0;
#endif
}
