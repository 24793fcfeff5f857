// Flat prefiltered maps, where a lookup reads as many texels as a pixel covers, by mipmaps or anisotropy.
#include "shadow/lookup/maps/flat_levels.glsl"
#include "shadow/passes/prefilter/pixel_footprint.glsl"

vec2 in_texels(ShadowPoint point, vec3 step_m) {
    ViewRecord view = light.views[point.view];
    vec3 along_w = row_xyz(view.map_from_anchor, 3);
    vec3 along_u = row_xyz(view.map_from_anchor, 0) - point.map.x * along_w;
    vec3 along_v = row_xyz(view.map_from_anchor, 1) - point.map.y * along_w;
    float w = dot(along_w, point.position_ca + view.anchor_from_camera.xyz) + view.map_from_anchor[3][3];
    return shortened(vec2(dot(along_u, step_m), dot(along_v, step_m)) / (w * point.texel_uv));
}

vec4 shadow_moments(ShadowPoint point) {
    return textureGrad(shadow_map, vec3(point.map.xy, point.layer), in_texels(point, step_right(point.position_ca, point.normal)) * point.texel_uv,
                       in_texels(point, step_up(point.position_ca, point.normal)) * point.texel_uv);
}
