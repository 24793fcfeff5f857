// Returns the share t = (distance - near) / (far - near) of a reversed depth, clamped to 0 to 1. range: see
// shadow/passes/prefilter/prefilter_block.glsl. stretch: distance from the light per distance along the view's axis.
float perspective_share(float depth, float stretch, vec4 range) {
    float distance_m = stretch * range.y / max(depth - range.x, 1e-30);
    return clamp((distance_m - range.z) * range.w, 0.0, 1.0);
}

// Returns the reversed depth of a share.
float perspective_depth(float share, float stretch, vec4 range) { return range.x + stretch * range.y / (range.z + share / range.w); }

float orthographic_share(float depth) { return clamp(1.0 - depth, 0.0, 1.0); }

// Distance of the corner of a cube's far plane, in distances of its middle.
const float kCubeCorner = 1.7320508;

// Returns the range of a view's depth alpha + beta / z, 1 at the near plane and 0 at the far one. farthest: in far
// distances.
vec4 share_range(float alpha, float beta, float farthest) {
    float near_m = beta / (1.0 - alpha);
    return vec4(alpha, beta, near_m, 1.0 / (farthest * beta / -alpha - near_m));
}
