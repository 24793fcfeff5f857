// Prefiltered cubes, where a lookup reads as many texels as a pixel covers, by mipmaps.
#include "shadow/lookup/maps/cube_levels.glsl"
#include "shadow/passes/prefilter/pixel_footprint.glsl"

// Turns a step in the world into one in texels of the face.
vec2 step_in_face(ShadowPoint point, vec3 step_ws) {
    vec3 step_m = turned_back(step_ws) * face_axes(point.position);
    vec2 step_tan = (vec2(step_m.x, step_m.y) + point.tangent * step_m.z) / largest(point.position);
    return shortened(step_tan / light.views[0].axis_u.w);
}

// Returns the moments over the pixel's footprint: taps along its longer side, as wide as its shorter one. A sampler
// would leave the face, and does not know which faces were drawn. Most pixels need one tap.
vec4 shadow_moments(ShadowPoint point) {
    vec2 right = step_in_face(point, step_right(point.position_ca, point.normal));
    vec2 up = step_in_face(point, step_up(point.position_ca, point.normal));
    vec2 longer = length(right) > length(up) ? right : up;
    float longer_texel = length(longer), shorter_texel = max(min(length(right), length(up)), 1.0);
    int taps = int(clamp(ceil(longer_texel / shorter_texel), 1.0, light.moment_sampling.z));
    float most_level = float(textureQueryLevels(shadow_map) - 1);
    float level = min(log2(max(longer_texel / float(taps), 1.0)), most_level);
    vec4 sum = vec4(0.0);
    int i = 0;
    do {
        sum += shadow_moments_at(point, longer * ((float(i) + 0.5) / float(taps) - 0.5), level);
    } while (++i < taps);
    return sum / float(taps);
}
