// Exposure and tone curve, and the sky behind everything. The target encodes sRGB. TRANSPARENT: no sky; alpha is the
// picture's coverage, and colours are premultiplied by it as light.
#include "common/bindings.glsl"
#include "lighting/post/sky.glsl"
#include "lighting/post/exposure.glsl"
#include "lighting/post/tone_curve.glsl"
layout(binding = kPictureUnit) uniform sampler2D picture;
layout(binding = kLuminanceUnit) uniform sampler2D luminance_sum;
layout(binding = kPictureDepthUnit) uniform sampler2D surface_depth;
layout(location = 0) out vec4 colour_out;

void main() {
    float scale = exposure_scale(luminance_sum) * exposure.z;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    // Blended surfaces may stand before the sky: what they let through is in the picture's alpha.
    vec4 seen = texelFetch(picture, pixel, 0);
    float alpha = 1.0;
#ifdef TRANSPARENT
    if (texelFetch(surface_depth, pixel, 0).r == 0.0) alpha = clamp(seen.a, 0.0, 1.0);
    if (alpha > 0.0) seen.rgb /= alpha;
#else
    if (texelFetch(surface_depth, pixel, 0).r == 0.0) seen.rgb += (1.0 - clamp(seen.a, 0.0, 1.0)) * sky_radiance(view_direction(pixel));
#endif
    // Unlit surfaces are shown as they are, by any exposure.
    float unlit = clamp(seen.a - 1.0, 0.0, 1.0);
    vec3 mapped = tone_curve(seen.rgb * mix(scale, 1.0 / ambient.ground.w, unlit));
    colour_out = vec4(alpha * min(mapped, vec3(1.0)), alpha);
}
