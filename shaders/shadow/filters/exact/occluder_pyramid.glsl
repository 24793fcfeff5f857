// Nearest depths that a texel holds for a source with a size (docs/explanation/exact_proof.md). C++ twin of
// levels: systems/shadow/request/occluder_pyramid.h.
#include "shadow/filters/exact/error_margins.glsl"
const int kEndsAcross = 4;   // squares of a level along a side of a square of the next
const float kUnknownNear = 2.0;   // before all that depth can be

// Returns by what share of its depth a facet that is not drawn may depart: FlatFacetTest. `texel_tan`: side of a texel; 0:
// parallel light, with a map that is cleared to that.
float floor_share(float texel_tan) {
    float share = 0.5 * kFloorTangent * texel_tan;
    return kDepartureFactor * share * (1.0 + 2.0 * share);
}

// Returns how near to the light anything comes in a texel that may keep a place from one verdict. x: lit by all of the
// source. y: dark to all of it. `bounds`: nearest contour, departure. `steepest`: change of depth in a texel from which
// a facet may lie within a cone.
vec2 ends_of_texel(float first, vec2 bounds, float texel_tan, float alpha, float steepest) {
    const float kMostShare = 0.2, kOfNearer = 1.25;   // 1 / (1 - kMostShare): what departs may be as much nearer
    float share = floor_share(texel_tan), most = max(first, bounds.x);
    if (share > kMostShare) return vec2(kUnknownNear);
    float off = max(bounds.y, kOfNearer * share * (most - alpha)) + kRoundings * kStoredUnits * kUnitRoundoff * max(most, 0.0);
    float nearest = most + off;
    bool is_steep = 2.0 * off >= steepest, may_end = first - off <= max(bounds.x, 0.0);
    return vec2(is_steep ? nearest : bounds.x, may_end ? nearest : -1.0);
}
