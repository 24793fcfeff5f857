// The bias, as docs/how-to/other_graphics_apis.md shows it. core_shader_bias_test.cpp compiles it as C++.
// [offset]
// texel, reach_texel, depth, depth_share: View::bias. n_map: geometric normal, p_map: position from eye_ws_m, both along
// axis_u, axis_v, axis_back. error_m: how far the position may be off. Returns metres along the normal, depth to add.
float2 shadow_offset(float3 n_map, float3 p_map, float error_m) {
    float across = reach_texel * dot(abs(n_map.xy), texel);
    if (orthographic) {
        across += error_m;
        bool steep = length(n_map.xy) > 4.0 * n_map.z;
        return steep ? float2(across, depth) : float2(0.0, depth + across / (n_map.z * (far_m - near_m)));
    }
    float z_m = -p_map.z, plane_m = -dot(n_map, p_map) - error_m;
    float beta = near_m * far_m / (far_m - near_m), stored = beta / z_m - near_m / (far_m - near_m);
    float across_m = across * z_m + error_m;
    bool steep = plane_m <= 0.0 || dot(p_map, p_map) > 17.0 * plane_m * plane_m;
    float rounding = depth + depth_share * stored;
    if (steep) return float2(across_m / (1.0 - min(across * max(-n_map.z, 0.0), 0.5)), rounding);
    return float2(0.0, rounding + beta * across_m / (z_m * plane_m));
}
// [offset]
