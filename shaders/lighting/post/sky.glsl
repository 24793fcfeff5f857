// Picture where there is no surface: the ambient light's own source, brighter toward the horizon, and the ground's
// below it.
#include "common/camera_block.glsl"
#include "lighting/lights/ambient.glsl"

vec3 view_direction(ivec2 pixel) {
    vec2 ndc = (vec2(pixel) + 0.5) / camera.unproject.zw * 2.0 - 1.0 + camera.lens.xy;
    bool orthographic = camera.back.w > 0.5;
    vec3 lateral = camera.right.xyz * (ndc.x * camera.right.w) + camera.up.xyz * (ndc.y * camera.up.w);
    return orthographic ? -camera.back.xyz : normalize(lateral - camera.back.xyz);
}

vec3 sky_radiance(vec3 direction) {
    const float kInversePi = 0.318309886;
    const float kHorizon_m1 = 12.0;         // how fast the horizon's haze fades with elevation: half within 3 degrees
    const float kZenithShare = 0.55;        // zenith's share of the mean: more light comes from nearer the horizon
    float haze = exp(-kHorizon_m1 * max(direction.y, 0.0));
    vec3 above = ambient.sky.rgb * mix(kZenithShare, 1.0, haze);
    return kInversePi * mix(ambient.ground.rgb, above, smoothstep(-0.01, 0.01, direction.y));
}
