// Edges between texels: four texels decide where they agree, sixteen vote where not.
#include "shadow/filters/pcf/texel_vote.glsl"

float shadow_filter(ShadowPoint point) {
    FourTexels four = four_texels(point);
    float voted = lit_by_sixteen(point, four.place, four.corner, four.all_lit || four.all_dark ? 0 : 16);
    return four.all_lit || (voted >= 0.0 && !four.all_dark) ? 1.0 : 0.0;
}
