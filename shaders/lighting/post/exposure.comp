// Puts the exposure where it can be read back: systems/lighting/exposure_meter.h.
#include "lighting/post/exposure.glsl"
layout(local_size_x = 1) in;
layout(binding = 1) uniform sampler2D luminance_sum;
layout(std430, binding = 0) buffer ExposureBuffer { float exposures[]; };

void main() { exposures[0] = exposure_scale(luminance_sum); }
