// Writes the exposure where it can be read back: systems/lighting/exposure_meter.h.
#include "common/bindings.glsl"
#include "lighting/post/exposure.glsl"
layout(local_size_x = 1) in;
layout(binding = kLuminanceUnit) uniform sampler2D luminance_sum;
layout(std430, binding = kExposureBuffer) buffer ExposureBuffer { float exposures[]; };

void main() { exposures[0] = exposure_scale(luminance_sum); }
