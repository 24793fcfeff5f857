// Edges of the casters themselves: where four texels do not agree, the triangles that they show are tested against the ray
// from the receiver to the light. Texels that show no triangle that could be tested are voted on.
#include "shadow/filters/votes.glsl"
#include "shadow/caster_triangles.glsl"

float shadow_filter(ShadowPoint point) {
    FourTexels four = four_texels(point);
    int verdict = kPasses;
    uvec2 last = uvec2(kNoTriangle);
    bool unknown = false;
    for (int i = 0; i < (four.all_lit || four.all_dark ? 0 : 4) && verdict != kBlocked; ++i) {
        if (four.plane[i] >= four.stored[i] || four.stored[i] == 0.0) continue;
        vec2 middle = four.corner + vec2(i == 1 || i == 2 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5);
        uvec2 shown = shadow_triangle(point, middle);
        if (shown == last) continue;
        last = shown;
        verdict = shown.y == kNoTriangle ? kUnknown : caster_verdict(shown, point.position_ca, point.error_m);
        unknown = unknown || verdict == kUnknown;
    }
    float voted = lit_by_sixteen(point, four.place, four.corner, unknown && verdict != kBlocked ? 4 : 0);
    bool lit = four.all_lit || (!four.all_dark && verdict != kBlocked && (!unknown || voted > 0.0));
    return lit ? 1.0 : 0.0;
}
