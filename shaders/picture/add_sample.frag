// Adds a picture to the sum of its samples. The texture decodes: light is added.
#include "common/bindings.glsl"
layout(binding = kFinishedPictureUnit) uniform sampler2D picture;
layout(location = 0) out vec4 sum_out;   // alpha: number of samples

void main() { sum_out = vec4(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb, 1.0); }
