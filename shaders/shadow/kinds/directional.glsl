// Directional light: orthographic views (cascades, near to far); the first that holds the point decides.
#include "shadow/light_block.glsl"
#include "shadow/bias.glsl"
#include "shadow/kinds/map_2d.glsl"

ShadowPoint shadow_point(vec3 position_ca, vec3 normal, float error_m, float reach_texel) {
    ShadowPoint point;
    point.covered = false;
    for (int i = 0; i < light.options.x && !point.covered; ++i) {
        ViewRecord view = light.views[i];
        vec3 position_la = position_ca + view.anchor_from_camera.xyz;
        vec3 n_map = vec3(dot(normal, view.axis_u.xyz), dot(normal, view.axis_v.xyz), dot(normal, view.axis_back.xyz));
        float rounding_m = error_m + view.numeric.y * (abs(position_la.x) + abs(position_la.y) + abs(position_la.z));
        Bias bias = orthographic_bias(view, n_map, reach_texel, rounding_m);
        if (light.options.y != 0) bias = Bias(0.0, light.bias.x / view.axis_back.w);
        vec3 moved = position_la + normal * bias.along_normal_m;
        vec4 projected = view.map_from_anchor * vec4(moved, 1.0);
        point = point_2d(i, projected, bias.depth, reach_texel);
        // A cascade draws only what can darken its own depth range: beyond it, the next one knows better.
        point.covered = point.covered && projected.z <= 1.0;
    }
    return point;
}
