// Logarithm of luminance where there is a surface, with its weight; the mip chain averages both.
layout(binding = 0) uniform sampler2D surface_depth;
layout(binding = 1) uniform sampler2D picture;
layout(location = 0) out vec2 sum_out;
const float kSide = 256.0;   // edge of this target, kLuminanceSide_px in systems/lighting/lighting_targets.cpp

void main() {
    ivec2 size = textureSize(picture, 0);
    ivec2 pixel = min(ivec2(gl_FragCoord.xy / kSide * vec2(size)), size - 1);
    float exists = texelFetch(surface_depth, pixel, 0).r > 0.0 ? 1.0 : 0.0;
    float luminance = dot(texelFetch(picture, pixel, 0).rgb, vec3(0.2126, 0.7152, 0.0722));   // Rec. 709
    bool usable = exists > 0.5 && luminance > 1e-6 && luminance < 1e9;   // black and infinite say nothing
    sum_out = usable ? vec2(log2(luminance), 1.0) : vec2(0.0);
}
