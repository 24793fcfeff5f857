// Factor of radiance before the tone curve.
#include "common/bindings.glsl"
layout(std140, binding = kExposureBlock) uniform ExposureBlock {
    vec4 exposure;   // x: scale; below 0: automatic.
                     // y: top mip of luminance_sum.
                     // z: radiance that 1 in the picture stands for.
                     // w: scale where nothing lit is seen.
};

// Returns the factor by which the logarithmic mean of what is seen becomes middle grey.
float exposure_scale(sampler2D luminance_sum) {
    if (exposure.x >= 0.0) return exposure.x;
    vec2 sum = textureLod(luminance_sum, vec2(0.5), exposure.y).rg;
    const float kMiddleGrey = 0.18;
    return sum.g > 0.0 ? kMiddleGrey / exp2(sum.r / sum.g) : exposure.w;
}
