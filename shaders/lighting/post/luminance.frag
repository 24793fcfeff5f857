// Logarithm of luminance where there is a lit surface, with its weight; the mip chain averages both.
#include "common/bindings.glsl"
#include "lighting/post/exposure.glsl"
#include "lighting/post/picture_sum.glsl"
layout(binding = kMeteredDepthUnit) uniform sampler2D surface_depth;
layout(binding = kMeteredPictureUnit) uniform sampler2D picture;
layout(location = 0) out vec2 sum_out;
const float kSide = 256.0;   // edge of this target, kLuminanceSide_px in systems/lighting/lighting_targets.cpp

void main() {
    ivec2 size = textureSize(picture, 0);
    ivec2 pixel = min(ivec2(gl_FragCoord.xy / kSide * vec2(size)), size - 1);
    float exists = texelFetch(surface_depth, pixel, 0).r > 0.0 ? 1.0 : 0.0;
    vec4 seen = texelFetch(picture, pixel, 0);
    float luminance = dot(seen.rgb, vec3(0.2126, 0.7152, 0.0722));   // Rec. 709
    const float kLeast = 1e-6;                                       // black has no logarithm
    const float kMostUnlit = 0.5;
    bool usable = exists > 0.5 && luminance > kLeast && seen.a - 1.0 < kMostUnlit;
    float logarithm = log2(clamp(luminance, kLeast, kMostInPicture) * exposure.z);
    sum_out = usable ? vec2(logarithm, 1.0) : vec2(0.0);
}
