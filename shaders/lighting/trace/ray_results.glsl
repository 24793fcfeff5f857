// Fraction of the light that reaches a surface, as already found for each pixel: by its light's map, or by a ray.
#include "common/bindings.glsl"
#include "shadow/lookup/shadow_layers.glsl"
#include "lighting/lights/light_sample.glsl"
layout(binding = kVerdictUnit) uniform usampler2D verdicts;   // lighting/trace/classify_pixels.frag
layout(binding = kAnswerUnit) uniform sampler2D answers;     // results of the rays, in the order of their list
#include "lighting/trace/ray_list_layout.glsl"

// Returns whether the map was not certain of the pixel.
bool is_listed(ivec2 pixel) { return texelFetch(verdicts, pixel, 0).x >= kListed; }

float found_visibility(ivec2 pixel) {
    uint verdict = texelFetch(verdicts, pixel, 0).x;
    float answer = texelFetch(answers, list_texel(int(max(verdict, kListed) - kListed), textureSize(answers, 0).x), 0).x;
    return verdict < kListed ? 1.0 - float(verdict) : answer;
}

float visible_share(Surface surface, LightSample incoming) {
    if (is_unreached(surface.geometric_normal, incoming)) return 0.0;
    if (!takes_shadow(surface.shadow_layers)) return 1.0;
    return found_visibility(ivec2(gl_FragCoord.xy));
}
