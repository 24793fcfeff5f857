// Edges of the casters themselves: where four texels do not agree, the triangles that they show are tested against the ray
// from the receiver to the light. Where a texel shows none that could be tested (leaves cut out of a card, meshes finer than the
// walk), the nearest texel decides: votes would take from coarse maps the leaves that are narrower than a texel.
#include "shadow/filters/votes.glsl"
#include "shadow/caster_triangles.glsl"

// What the four show above the receiver's plane: each triangle once, as many as `count`. Found first and tested together,
// because software devices take as many rounds as the slowest of neighbouring pixels.
struct Shown {
    uvec2 triangles[4];
    int count;
};

// `texels`: 4, or 0 for none.
Shown shown_above(ShadowPoint point, FourTexels four, int texels) {
    Shown shown;
    shown.count = 0;
    for (int i = 0; i < texels; ++i) {
        if (four.plane[i] >= four.stored[i] || four.stored[i] == 0.0) continue;
        vec2 middle = four.corner + vec2(i == 1 || i == 2 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5);
        uvec2 triangle = shadow_triangle(point, middle);
        if (shown.count > 0 && shown.triangles[shown.count - 1] == triangle) continue;
        shown.triangles[shown.count++] = triangle;
    }
    return shown;
}

float shadow_filter(ShadowPoint point) {
    FourTexels four = four_texels(point);
    Shown shown = shown_above(point, four, four.all_lit || four.all_dark ? 0 : 4);
    int verdict = kPasses;
    bool unknown = false;
    for (int i = 0; i < shown.count && verdict != kBlocked; ++i) {
        verdict = caster_verdict(shown.triangles[i], point.position_ca, point.error_m);
        unknown = unknown || verdict == kUnknown;
    }
    vec2 middle = floor(four.place) + 0.5;
    float nearest = lit_at(point, four.place, middle, shadow_depth(point, middle));
    bool lit = four.all_lit || (!four.all_dark && verdict != kBlocked && (!unknown || nearest > 0.0));
    return lit ? 1.0 : 0.0;
}
