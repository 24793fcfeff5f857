// Edges of the casters themselves. Where four texels do not agree, the triangles that they show are tested against the
// ray from the receiver to the light, with their masks. Where a test comes to no end (meshes finer than the walk,
// leaves finer than texels), the nearest texel decides.
#include "shadow/filters/pcf/texel_vote.glsl"
#include "shadow/filters/triangles/mesh_walk.glsl"
#include "shadow/filters/triangles/own_surface.glsl"

// Returns a bit for the first texel that shows each triangle, among texels that may darken and show any.
int different(FourTexels four, bvec4 may, FourTriangles shown) {
    int bits = 0;
    for (int i = 0; i < 4; ++i) {
        bool is_new = may[i] && four.stored[i] > 0.0;
        for (int j = 0; j < i; ++j)
            is_new = is_new && !((bits >> j & 1) != 0 && shown.triangle[j] == shown.triangle[i] && shown.instance[j] == shown.instance[i]);
        if (is_new) bits |= 1 << i;
    }
    return bits;
}

#ifdef LEAVE_UNDECIDED
// true where texels do not agree, in the first draw of a light.
bool shadow_undecided = false;

float shadow_filter(ShadowPoint point) {
    FourTexels four = four_texels(point);
    bool lit = !any(may_darken(point, four));
    shadow_undecided = shadow_undecided || !(lit || four.all_dark);
    return lit ? 1.0 : 0.0;
}
#else
// Returns 1 where the receiver is lit, else 0. What is tested is found first, because loops take as many rounds as the
// slowest of neighbouring pixels. Software devices run both sides of an `if`, thus each loop once. Conditions
// of loops come last: tested before a round, they cost one round more than any pixel needs.
float lit_in_middle(ShadowPoint point) {
    FourTexels four = four_texels(point);
    bvec4 may = may_darken(point, four);
    bool lit = !any(may);
    float error_m = error_along_view_m(point.position_ca, point.normal, point.error_m);
    if (!(lit || four.all_dark)) {
        FourTriangles shown = shadow_triangles_around(point, four.corner);
        int verdict = casters_verdict(shown, different(four, may, shown), point.position_ca, point.normal, error_m, shadow_texel_sides(point));
        bool unknown = verdict == kUnknown;
        lit = verdict != kBlocked;
        if (unknown && lit) {
            vec2 middle = floor(four.place) + 0.5;
            lit = lit_at(point, four.place, middle, shadow_depth(point, middle)) > 0.0;
        }
    }
    return lit ? 1.0 : 0.0;
}

#if SHADOW_ANTIALIAS
#include "shadow/filters/triangles/area_walk.glsl"
#include "shadow/filters/triangles/over_area.glsl"
#ifdef AREAS_ALONE
// true where an edge crosses the area.
bool shadow_crossed = false;

float shadow_filter(ShadowPoint point) {
    float share = area_share(point);
    shadow_crossed = shadow_crossed || (share > 0.0 && share < 1.0);
    return share;
}
#else
float shadow_filter(ShadowPoint point) {
    float share = area_share(point);
    return share > 0.0 && share < 1.0 ? share : lit_in_middle(point);
}
#endif
#else
float shadow_filter(ShadowPoint point) { return lit_in_middle(point); }
#endif
#endif
