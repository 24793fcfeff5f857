// Smallest offset that keeps a plane from shadowing itself in an orthographic map that is warped across the light.
// Depth is h / (range * w): h metres toward the light from the anchor, w = 1 + dot(gradient, position). Derivation:
// docs/explanation/bias.md.

// Error of a row of the map's matrix, relative: its entries, products and sums.
const float kRowRounding = 4.0 * kUnitRoundoff;
// Error of coordinates in the map, as a share of its side: as it is drawn and as it is looked up.
const float kMapRounding = 12.0 * kUnitRoundoff;

// Largest change of w by a move along the normal. Where it would be larger, the offset goes along the light.
const float kMostMove = 0.5;

vec3 warp_gradient(ViewRecord view) {
    return vec3(view.map_from_anchor[0].w, view.map_from_anchor[1].w, view.map_from_anchor[2].w);
}

float warp_at(ViewRecord view, vec3 position_la) { return 1.0 + dot(warp_gradient(view), position_la); }

float cascade_range_m(ViewRecord view, vec3 position_la) { return view.axis_back.w * warp_at(view, position_la); }

// Returns the bias in a warped map. Depth is affine in the map's coordinates on any plane, so the slope term is exact.
// Per texel it changes by (n.u + (gradient.u) D) * texel / (n.z * range). D: distance of the anchor from the plane.
Bias cascade_bias(ViewRecord view, vec3 position_la, vec3 normal, vec3 n_map, float reach_texel, float error_m) {
    vec3 gradient = warp_gradient(view);
    float w = warp_at(view, position_la);
    float distance_m = length(position_la);
    float plane_m = dot(normal, position_la);
    vec2 turn = vec2(dot(gradient, view.axis_u.xyz), dot(gradient, view.axis_v.xyz));
    vec2 slope = abs(n_map.xy + turn * plane_m) + kNormalError_rad * (1.0 + abs(turn) * distance_m) + abs(turn) * error_m;
    float footprint_texel = reach_texel + kRasterSnap_texel + kMapRounding * shadow_map_size().x;
    float w_error = kRowRounding * (1.0 + length(gradient) * distance_m);
    float across_m = footprint_texel * dot(slope, vec2(view.axis_u.w, view.axis_v.w)) + (error_m + distance_m * w_error) / w;

    float cosine = n_map.z - kNormalError_rad;
    float move = across_m * dot(gradient, normal);   // change of the anchor's w
    bool steep = !(length(abs(n_map.xy) + kNormalError_rad) <= kSteepTangent * cosine) && abs(move) <= kMostMove;
    float range_m = view.axis_back.w;
    float depth = dot(view.axis_back.xyz, position_la) / (range_m * w);
    Bias bias;
    bias.along_normal_m = steep ? across_m * w / (1.0 - move) : 0.0;
    bias.depth = view.numeric.x + depth * w_error / w + (steep ? 0.0 : across_m / (max(cosine, kNormalError_rad) * range_m));
    return taken_bias(bias);
}
