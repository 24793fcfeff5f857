// Edges of the casters themselves: where four texels do not agree, the triangles that they show are tested against the ray
// from the receiver to the light, and the masks of those that are masked. Where a test comes to no end (meshes finer than the
// walk, leaves finer than texels), the nearest texel decides.
#include "shadow/filters/votes.glsl"
#include "shadow/caster_triangles.glsl"

// A texel that shows the receiver's own surface is off the receiver's plane by less than this, in slopes per texel: a curved
// mesh bends. What lies farther below the plane, but above the receiver, is another surface, before which a plane that the
// light grazes has come to lie within part of a texel.
const float kOwnSurface_texel = 0.25;

// Which of the four may show what darkens the receiver.
bvec4 may_darken(ShadowPoint point, FourTexels four) {
    vec4 below = four.plane - four.stored;
    float own = kOwnSurface_texel * (abs(point.slope.x) + abs(point.slope.y));
    bvec4 other;
    for (int i = 0; i < 4; ++i) other[i] = below[i] < 0.0 || (below[i] > own && four.stored[i] > point.reference);
    return other;
}

// What the four show that may darken the receiver: each triangle once, as many as `count`. Found first and tested together,
// because software devices take as many rounds as the slowest of neighbouring pixels.
struct Shown {
    uvec2 triangles[4];
    int count;
};

// `texels`: 4, or 0 for none.
Shown shown_before(ShadowPoint point, FourTexels four, bvec4 may, int texels) {
    Shown shown;
    shown.count = 0;
    for (int i = 0; i < texels; ++i) {
        if (!may[i] || four.stored[i] == 0.0) continue;
        vec2 middle = four.corner + vec2(i == 1 || i == 2 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5);
        uvec2 triangle = shadow_triangle(point, middle);
        if (shown.count > 0 && shown.triangles[shown.count - 1] == triangle) continue;
        shown.triangles[shown.count++] = triangle;
    }
    return shown;
}

float shadow_filter(ShadowPoint point) {
    FourTexels four = four_texels(point);
    bvec4 may = may_darken(point, four);
    Shown shown = shown_before(point, four, may, !any(may) || four.all_dark ? 0 : 4);
    int verdict = kPasses;
    bool unknown = false;
    for (int i = 0; i < shown.count && verdict != kBlocked; ++i) {
        verdict = caster_verdict(shown.triangles[i], point.position_ca, point.error_m, shadow_texel_sides(point));
        unknown = unknown || verdict == kUnknown;
    }
    vec2 middle = floor(four.place) + 0.5;
    float nearest = lit_at(point, four.place, middle, shadow_depth(point, middle));
    bool lit = !any(may) || (!four.all_dark && verdict != kBlocked && (!unknown || nearest > 0.0));
    return lit ? 1.0 : 0.0;
}
