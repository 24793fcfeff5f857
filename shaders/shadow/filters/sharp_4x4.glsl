// Edges between texels: every texel says whether the receiver's plane is lit at its middle; near ones outvote far ones.
// Reads depths: SHADOW_DEPTHS. Four texels decide where they agree, sixteen where not.

// Width of the votes: a bar as wide as a texel just holds half of them, 2 Phi(1 / (2 sigma)) - 1 = 1/2, and is kept.
const float kVotes_texel = 0.7413;
// A curved mesh bends between texels: this share of the bend counts for the receiver, by measurement (docs/accuracy.md).
const float kBendShare = 0.25;
// The bend is no reason for more than a nearest tap would have allowed for the slope.
const float kMostSlope_texel = 0.5;

// Shadowed where what is stored stands above the receiver's plane, and above the receiver too when it is carried on to
// it by its own slope. The first alone is wrong in creases: there the neighbouring plane runs out below the receiver.
float lit_at(ShadowPoint point, vec2 place, vec2 middle, float stored) {
    vec2 aside = middle - place;
    if (point.reference + dot(point.slope, aside) >= stored) return 1.0;
    vec2 away = vec2(aside.x < 0.0 ? -1.0 : 1.0, aside.y < 0.0 ? -1.0 : 1.0);
    vec2 rise = vec2(stored - shadow_depth(point, middle + vec2(away.x, 0.0)), stored - shadow_depth(point, middle + vec2(0.0, away.y)));
    vec2 bend = abs(rise + away * point.slope);
    float allowed = min(kMostSlope_texel * (abs(point.slope.x) + abs(point.slope.y)), kBendShare * (bend.x + bend.y));
    return point.reference + allowed >= stored + dot(rise, abs(aside)) ? 1.0 : 0.0;
}

// `rows`: 4, or 0 for none; a loop, because software devices run both sides of an if, but no empty loop.
float lit_by_sixteen(ShadowPoint point, vec2 place, vec2 corner, int rows) {
    float lit = 0.0, all_votes = 0.0;
    for (int y = -2; y < rows - 2; ++y)
        for (int x = -2; x < 2; ++x) {
            vec2 middle = corner + vec2(x, y) + 0.5;
            float apart = length(middle - place) / kVotes_texel;
            float votes = exp(-0.5 * apart * apart);
            lit += votes * lit_at(point, place, middle, shadow_depth(point, middle));
            all_votes += votes;
        }
    return 2.0 * lit >= all_votes ? 1.0 : 0.0;
}

float shadow_filter(ShadowPoint point) {
    vec2 place = shadow_place(point);
    vec2 corner = floor(place + 0.5);
    vec4 stored = shadow_depths(point, corner);   // in textureGather's order: (-,+) (+,+) (+,-) (-,-)
    vec2 low = corner - 0.5 - place, high = low + 1.0;
    vec4 plane = point.reference + point.slope.x * vec4(low.x, high.x, high.x, low.x) + point.slope.y * vec4(high.y, high.y, low.y, low.y);
    bool all_lit = all(greaterThanEqual(plane, stored));
    // Far enough above that no crease can be meant.
    float clear = point.reference + abs(point.slope.x) + abs(point.slope.y);
    bool all_dark = all(greaterThan(stored, max(plane, vec4(clear))));
    float voted = lit_by_sixteen(point, place, corner, all_lit || all_dark ? 0 : 4);
    return all_lit || (voted > 0.0 && !all_dark) ? 1.0 : 0.0;
}
