// What was found of a pixel: by its light's map, or by a ray.
layout(binding = 5) uniform usampler2D verdicts;   // lighting/trace/classify_pixels.frag
layout(binding = 7) uniform sampler2D answers;     // of the rays, in the order of their list
#include "lighting/trace/ray_list_layout.glsl"

float found_visibility(ivec2 pixel) {
    uint verdict = texelFetch(verdicts, pixel, 0).x;
    float answer = texelFetch(answers, list_texel(int(max(verdict, kListed) - kListed), textureSize(answers, 0).x), 0).x;
    return verdict < kListed ? 1.0 - float(verdict) : answer;
}
