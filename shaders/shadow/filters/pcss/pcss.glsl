// Shadows as soft as the source is large (percentage-closer soft shadows, Fernando 2005). A search finds how far before
// the receiver its casters are, and thus how wide its penumbra is. A disk of taps of that width then measures how much
// of the source they hide.
// A texel counts only if what it shows stands above the receiver's plane, and within the cone from the receiver to the
// source (light_size.glsl). High casters that lie too far aside darken nothing, nor does the wall that the receiver
// meets.
// A length along the map is stored as the depth at which the cone is as wide. Where the penumbra is narrower than a
// texel, votes locate its middle. If the source has no size, they decide.
#include "shadow/filters/disk/noise_seed.glsl"
#include "shadow/filters/disk/stratified_disk.glsl"
#include "shadow/filters/pcf/texel_vote.glsl"
#include "shadow/filters/pcss/stands_before.glsl"

// Least radius of a penumbra. Narrower ones are left to votes, which measure the edge's distance up to about a texel.
const float kLeastPenumbra_texel = 0.75;
// Least distance of the edge where four texels agree.
const float kAgreed_texel = 0.5;
// Texels per vote: see lit_by_sixteen().
const float kTexelPerVotes = 0.9291;
// Width of a smooth step that is as steep as the share of a disk beside an edge, in widths of the disk.
const float kDiskStep = 1.13;
// Taps of the search per octave: it looks at all scales alike, since a low caster's cone is a small part of a high
// one's.
const float kSearchTapsPerOctave = 4.0;
// Least radius of the search: a penumbra of this radius is as good as none.
const float kLeastSearch_texel = 0.5;
// Ratio of heights up to which casters are one, for which one disk does.
const float kSameLayer = 2.0;
// Distance aside, in widths of its cone, from which a caster has no edge in the penumbra.
const float kFarAside = 3.0;
// Least share of the mean height at which a caster counts as the disk's own: it may lean away from the receiver.
const float kSameCaster = 0.7;
// Number of the disk's outermost taps, which come first. Where all of them are dark, or lit and the search found
// nothing between them, so are the others.
const int kRimTaps = 8;
// Taps per texel of the penumbra's radius: the disk has more texels, but a straight edge crosses no more of its rings.
const float kTapsPerTexel = 4.0;

#if SHADOW_SPREAD
#include "shadow/filters/area_spread.glsl"
#include "shadow/filters/pcss/area_radius.glsl"

// Moves a tap's receiver along its plane.
void move_receiver(vec3 beside_m, inout ShadowPoint point, inout vec2 place) {
    vec2 moved = texels_moved(point, beside_m);
    place += moved;
    point.reference += dot(point.slope, moved);
}

// Greatest radius of what votes blur: votes that all agree are a whole step away.
const float kMostVoted_texel = kTexelPerVotes / kDiskStep;
#endif

#if LIGHT_AREA
#include "shadow/filters/pcss/source_on_map.glsl"
#else
// Returns a place of the disk as texels from the receiver, at depth 1 of the cone.
vec2 on_map(ShadowPoint point, vec2 disk) {
    float stretch = 1.0 / (source_stretch(point.tangent) + 1.0);
    return point.source_texel * (disk + point.tangent * (dot(point.tangent, disk) * stretch));
}
#endif

// Casters of two heights, in the order in which they are found: a low one's shadow is sharp also where a high one's is
// not.
struct Casters {
    vec2 before;    // mean distance before the receiver, in depth; casters with the receiver in their cones count most
    vec2 weights;   // 0: there is none
    float aside;    // least distance of a caster aside, in radii of its own cone; kFarAside: none is nearer
};

// Finds the casters. `reach`: the widest cone, in depth. `octaves`: from penumbrae that votes decide up to it.
Casters find_casters(ShadowPoint point, vec2 place, vec2 seed, float reach, float octaves) {
    Casters found;
    found.before = found.weights = vec2(0.0);
    found.aside = kFarAside;
    int taps = int(ceil(kSearchTapsPerOctave * octaves));
    int i = 0;
    if (taps > 0) do {
        float share = (float(i) + seed.x) / float(taps);
        float aside = reach * exp2(-octaves * share);
        float before = stands_before(point, place, aside * on_map(point, on_circle(seed.y + kGolden * float(i))));
        float cones = before > 0.0 ? aside / before : kFarAside;
        if (cones >= kFarAside) continue;
        float weight = 1.0 / max(1.0, cones * cones * cones * cones);
        float first = found.before.x;
        int layer = first == 0.0 || max(first, before) < kSameLayer * min(first, before) ? 0 : 1;
        found.weights[layer] += weight;
        found.before[layer] += (before - found.before[layer]) * (weight / found.weights[layer]);
        found.aside = min(found.aside, cones);
    } while (++i < taps);
    return found;
}

// Returns how much of the source is seen past the casters that stand `before` the receiver: the disk's radius, in
// depth. Casters that stand less than `from` do not count. What stands `to` or more hides what is below.
float lit_by_disk(ShadowPoint point, vec2 place, vec2 seed, int taps, float before, float from, float to, bool clear_inside) {
    float lit = 0.0;
    float known = 0.0;
#if SHADOW_SPREAD
    PixelArea area = pixel_area(point.position_ca, point.normal);
#endif
    int i = taps - 1;
    do {
        vec2 disk = stratified_disk(seed, i, taps);
        ShadowPoint tap = point;
        vec2 tap_place = place;
#if SHADOW_SPREAD
        move_receiver(spread_place(area, i), tap, tap_place);
#endif
        float stands = stands_before(tap, tap_place, before * on_map(point, disk));
        if (stands >= to) continue;
        known += 1.0;
        lit += stands > max(from, before * min(length(disk), kSameCaster)) ? 0.0 : 1.0;
        if (i == taps - kRimTaps && (lit == 0.0 || (lit == known && clear_inside))) break;
    } while (--i >= 0);
    return known > 0.0 ? lit / known : 1.0;
}

// Returns a penumbra around the edge that sixteen texels vote for. If not `wanted`, it may leave the votes out.
float lit_by_votes(ShadowPoint point, float radius_texel, bool wanted) {
    FourTexels four = four_texels(point);
    bool agreed = (four.all_lit || four.all_dark) && radius_texel < kAgreed_texel;
    float votes = lit_by_sixteen(point, four.place, four.corner, wanted && !agreed ? 16 : 0);
    if (agreed) return four.all_lit ? 1.0 : 0.0;
    if (radius_texel == 0.0) return votes >= 0.0 ? 1.0 : 0.0;
    float half_width = kDiskStep * radius_texel;
    return smoothstep(-half_width, half_width, votes * kTexelPerVotes);
}

float shadow_filter(ShadowPoint point) {
#if LIGHT_AREA
    map_source = source_on_map(point);
#endif
    vec2 place = shadow_place(point);
    vec2 seed = shadow_seed(point);
    float texels = max(point.source_texel.x, point.source_texel.y) * source_stretch(point.tangent);
    float reach_texel = source_reach_texel(point.source_texel, point.tangent, point.reference);
    float octaves = max(log2(max(reach_texel, kLeastSearch_texel) / kLeastSearch_texel), 0.0);
    float reach = octaves > 0.0 ? reach_texel / texels : 0.0;
    Casters found = find_casters(point, place, seed, reach, octaves);
    bool two = found.weights.y > 0.0;
    float split = two ? sqrt(found.before.x * found.before.y) : 0.0;
    float radius_texel = min(found.before.x, reach) * texels;
    bool narrow = !two && radius_texel < kLeastPenumbra_texel;
    blurred_texel = min(max(found.before.x, found.before.y), reach) * source_stretch(point.tangent) * point.source_texel;
#if SHADOW_SPREAD
    float lit = lit_by_votes(point, min(length(vec2(radius_texel, area_radius_texel(point))), kMostVoted_texel), narrow);
#else
    float lit = lit_by_votes(point, radius_texel, narrow);
#endif
    if (!narrow) lit = 1.0;
    int layer = 0;
    if (!narrow) do {
        float before = clamp(found.before[layer], kLeastPenumbra_texel / texels, reach);
        int taps = min(max(kRimTaps, int(ceil(kTapsPerTexel * texels * before))), light.filtering.y);
        bool low = two && found.before[layer] < split;
        lit *= lit_by_disk(point, place, seed, taps, before, low ? 0.0 : split, low ? split : 2.0, found.aside >= 1.0);
    } while (++layer < (two ? 2 : 1));
    return lit;
}
