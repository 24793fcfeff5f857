// Votes of texels: each compares the receiver's plane with its depth, at its own middle. The four around the receiver
// decide if they agree. Otherwise sixteen vote, and near ones outvote far ones. Requires SHADOW_DEPTHS.

// Width of the votes: a bar as wide as a texel just holds half of them, 2 Phi(1 / (2 sigma)) - 1 = 1/2, and is kept.
const float kVotes_texel = 0.7413;
// Share of a curved mesh's bend between texels that counts for the receiver, by measurement (docs/results/accuracy.md).
const float kBendShare = 0.25;
// Most slopes that a bend adds: no more than a nearest tap would have allowed for the slope.
const float kMostSlope_texel = 0.5;

// Returns 0 if the stored depth lies above the receiver's plane, and above the receiver itself when carried there by
// its own slope. Else returns 1. The first condition alone is wrong in creases: there the neighbouring plane runs out
// below the receiver.
float lit_at(ShadowPoint point, vec2 place, vec2 middle, float stored) {
    vec2 aside = middle - place;
    if (point.reference + dot(point.slope, aside) >= stored) return 1.0;
    vec2 away = vec2(aside.x < 0.0 ? -1.0 : 1.0, aside.y < 0.0 ? -1.0 : 1.0);
    vec2 rise = vec2(stored - shadow_depth(point, middle + vec2(away.x, 0.0)), stored - shadow_depth(point, middle + vec2(0.0, away.y)));
    vec2 bend = abs(rise + away * point.slope);
    float allowed = min(kMostSlope_texel * (abs(point.slope.x) + abs(point.slope.y)), kBendShare * (bend.x + bend.y));
    return point.reference + allowed >= stored + dot(rise, abs(aside)) ? 1.0 : 0.0;
}

// Returns the votes for lit less those for dark, as a share of all, -1 to 1. It is 0 at the edge, and rises by 1 over
// kVotes_texel * sqrt(pi / 2) texels. `rounds`: 16, or 0 for no votes; a number that compilers know they would unroll. It
// is one loop for software devices: see shadow/filters/triangles/triangles.glsl.
float lit_by_sixteen(ShadowPoint point, vec2 place, vec2 corner, int rounds) {
    float lit = 0.0, all_votes = 0.0;
    int i = 0;
    if (rounds > 0) do {
        vec2 middle = corner + vec2(i % 4 - 2, i / 4 - 2) + 0.5;
        float apart = length(middle - place) / kVotes_texel;
        float votes = exp(-0.5 * apart * apart);
        lit += votes * lit_at(point, place, middle, shadow_depth(point, middle));
        all_votes += votes;
    } while (++i < rounds);
    return all_votes > 0.0 ? (2.0 * lit - all_votes) / all_votes : 0.0;
}

// Four texels around the receiver, in textureGather's order: (-,+) (+,+) (+,-) (-,-).
struct FourTexels {
    vec2 place, corner;    // the receiver's, and the corner between them
    vec4 stored, plane;    // depth, and the receiver's plane at their middles
    bool all_lit, all_dark;
};

FourTexels four_texels(ShadowPoint point) {
    FourTexels four;
    four.place = shadow_place(point);
    four.corner = floor(four.place + 0.5);
    four.stored = shadow_depths(point, four.corner);
    vec2 low = four.corner - 0.5 - four.place, high = low + 1.0;
    four.plane = point.reference + point.slope.x * vec4(low.x, high.x, high.x, low.x) + point.slope.y * vec4(high.y, high.y, low.y, low.y);
    four.all_lit = all(greaterThanEqual(four.plane, four.stored));
    // Far enough above that no crease can be meant.
    float clear = point.reference + abs(point.slope.x) + abs(point.slope.y);
    four.all_dark = all(greaterThan(four.stored, max(four.plane, vec4(clear))));
    return four;
}
