// Spot light: one perspective view.
#include "shadow/light_block.glsl"
#include "shadow/bias.glsl"
#include "shadow/kinds/map_2d.glsl"

ShadowPoint shadow_point(vec3 position_ca, vec3 normal, float error_m, float reach_texel) {
    ViewRecord view = light.views[0];
    vec3 position_la = position_ca + view.anchor_from_camera.xyz;
    mat3 map_axes = mat3(view.axis_u.xyz, view.axis_v.xyz, view.axis_back.xyz);
    vec3 n_map = normal * map_axes;
    vec3 position_map = position_la * map_axes;
    float rounding_m = error_m + view.numeric.y * length(position_la);
    Bias bias = perspective_bias(view, n_map, abs(n_map.xy), position_map, reach_texel, rounding_m);
    if (light.options.y != 0) {
        float z_m = -position_map.z;
        bias = Bias(0.0, view.axis_back.w * light.bias.x / (z_m * z_m));
    }
    vec3 moved = position_la + normal * bias.along_normal_m;
    return point_2d(0, view.map_from_anchor * vec4(moved, 1.0), bias.depth, 0.0);
}
