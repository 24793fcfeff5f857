// Spot light: one perspective view; for a wide cone, faces of a cube around it; while one fades into the other, both, the
// faces first.
#include "shadow/light_block.glsl"
#include "shadow/bias.glsl"
#include "shadow/kinds/map_2d.glsl"
#define SHADOW_FADES

ShadowPoint point_in_view(int i, vec3 position_la, vec3 normal, float error_m, float reach_texel) {
    ViewRecord view = light.views[i];
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
    return point_2d(i, view.map_from_anchor * vec4(moved, 1.0), bias.depth, 0.0);
}

vec3 from_light(vec3 position_ca) { return position_ca + light.views[0].anchor_from_camera.xyz; }

// The face that looks most nearly along the direction. A face without a view casts nothing that is seen.
ShadowPoint point_in_faces(int faces, vec3 position_la, vec3 normal, float error_m, float reach_texel) {
    int best = 0;
    float deepest = 0.0;
    for (int i = 0; i < faces; ++i) {
        float z_m = -dot(position_la, light.views[i].axis_back.xyz);
        if (z_m > deepest) {
            deepest = z_m;
            best = i;
        }
    }
    ShadowPoint point = point_in_view(best, position_la, normal, error_m, reach_texel);
    point.covered = point.covered && deepest > 0.0;
    return point;
}

bool has_single_view() { return light.cone.z < 1.0 && (light.cone.z == 0.0 || (light.options.w & 32) != 0); }

ShadowPoint shadow_point(vec3 position_ca, vec3 normal, float error_m, float reach_texel) {
    if (has_single_view()) return point_in_view(light.options.x - 1, from_light(position_ca), normal, error_m, reach_texel);
    return point_in_faces(light.options.x, from_light(position_ca), normal, error_m, reach_texel);
}

// Where one of the two has no view, it has nothing to fade.
float shadow_fade_share() { return has_single_view() && light.options.x > 1 ? light.cone.z : 0.0; }

ShadowPoint shadow_fade_point(vec3 position_ca, vec3 normal, float error_m, float reach_texel) {
    return point_in_faces(light.options.x - 1, from_light(position_ca), normal, error_m, reach_texel);
}
