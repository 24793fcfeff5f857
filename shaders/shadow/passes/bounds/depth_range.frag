// Departure of a triangle from its depth in the middle of each texel that it overlaps. MASKED: how near it comes there.
#include "shadow/passes/depth/depth_view_block.glsl"
#include "shadow/filters/exact/error_margins.glsl"
flat in vec4 edge_ab, edge_bc, edge_ca, depth_plane, inverse_w, box_texel, errors;
flat in float nearest;
layout(location = 0) out vec2 bounds_out;   // nearest contour, departure

// Returns whether an edge of the triangle leaves the texel's square on its inner side. The triangle's edges are its
// separating axes; the square's own are box_texel.
bool is_inside(vec4 edge, float side, vec3 middle, float half_side) {
    return side * dot(edge.xyz, middle) + half_side * (abs(edge.x) + abs(edge.y)) + edge.w >= 0.0;
}
bool is_inside(float side, vec3 middle, float half_side) {
    return is_inside(edge_ab, side, middle, half_side) && is_inside(edge_bc, side, middle, half_side) &&
           is_inside(edge_ca, side, middle, half_side);
}

void main() {
    float size = depth_view.anchor_high.w;
    vec2 texel = gl_FragCoord.xy;
    vec3 middle = vec3(texel / size * 2.0 - 1.0, 1.0);
    float half_side = kTexelHalf * 2.0 / size;
    float departure = errors.w;
    bool over = all(greaterThanEqual(texel, box_texel.xy)) && all(lessThanEqual(texel, box_texel.zw)) &&
                (is_inside(1.0, middle, half_side) || (departure >= kUnknownDeparture && is_inside(-1.0, middle, half_side)));
    if (!over) discard;
    if (departure < kUnknownDeparture) {
        float most_inverse = abs(dot(inverse_w.xyz, middle)) + inverse_w.w;
        float depth = abs(dot(depth_plane.xyz, middle)) + depth_plane.w + departure;
        float moved_texel = (errors.x + errors.z) * most_inverse * 0.5 * size;
        departure = kDepartureFactor * departure + (errors.y + errors.z * depth) * most_inverse;
        if (moved_texel > kMostMoved_texel) departure = kUnknownDeparture;
    }
#ifdef MASKED
    float depth = departure < kUnknownDeparture ? dot(depth_plane.xyz, middle) + depth_plane.w + departure : nearest;
    bounds_out = vec2(min(depth, nearest), 0.0);
#else
    bounds_out = vec2(-1.0, departure);
#endif
}
