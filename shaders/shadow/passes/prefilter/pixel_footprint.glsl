// Part of the receiver's plane that a pixel covers, and so of a prefiltered map. Its derivatives cannot be spoilt by a
// neighbouring pixel's surface, cascade or loop. Requires CameraBlock.
#include "common/float_rounding.glsl"

// Returns how far the plane's point moves as the pixel moves by one, metres. across: camera.right or camera.up; pixels:
// of the picture along it.
vec3 pixel_step(vec4 across, float pixels, vec3 position_ca, vec3 normal) {
    bool orthographic = camera.back.w != 0.0;
    vec3 ray = orthographic ? -camera.back.xyz : position_ca;
    float width_m = 2.0 * across.w / pixels * (orthographic ? 1.0 : -dot(position_ca, camera.back.xyz));
    vec3 beside = width_m * across.xyz;
    float facing = dot(normal, ray);
    float least = kNormalError_rad * length(ray);
    if (abs(facing) < least) facing = facing < 0.0 ? -least : least;
    return beside - ray * (dot(normal, beside) / facing);
}

vec3 step_right(vec3 position_ca, vec3 normal) { return pixel_step(camera.right, camera.unproject.z, position_ca, normal); }
vec3 step_up(vec3 position_ca, vec3 normal) { return pixel_step(camera.up, camera.unproject.w, position_ca, normal); }

// Limits a step to what the bias and the map's border serve.
vec2 shortened(vec2 step_texel) { return step_texel * min(1.0, light.moment_sampling.y / max(length(step_texel), 1e-30)); }
