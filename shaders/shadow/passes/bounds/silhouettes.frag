// Nearest depth of an edge in each texel that it crosses (Liang and Barsky 1984).
flat in vec4 ends_texel;
flat in vec2 end_depths;
flat in float half_texel;
layout(location = 0) out vec2 bounds_out;   // nearest contour, departure

void main() {
    const float kUpright_texel = 1e-3;   // shorter: it may be anywhere along that axis
    vec2 from = ends_texel.xy - gl_FragCoord.xy, along = ends_texel.zw - ends_texel.xy;
    vec2 part = vec2(0.0, 1.0);
    bool over = true;
    for (int axis = 0; axis < 2; ++axis) {
        if (abs(along[axis]) < kUpright_texel) {
            over = over && abs(from[axis]) <= half_texel + kUpright_texel;
        } else {
            vec2 at = (vec2(-half_texel, half_texel) - from[axis]) / along[axis];
            part = vec2(max(part.x, min(at.x, at.y)), min(part.y, max(at.x, at.y)));
        }
    }
    if (!over || part.x > part.y) discard;
    bounds_out = vec2(max(mix(end_depths.x, end_depths.y, part.x), mix(end_depths.x, end_depths.y, part.y)), 0.0);
}
