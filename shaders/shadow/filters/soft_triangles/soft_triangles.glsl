// Shadows as soft as the source is large, by the casters' own triangles. A search finds texels that show casters in the
// cone from the receiver to the source. Their triangles and the neighbours in the mesh hide places of the source. What
// has no triangles, or too many, hides them by its depth.
#include "shadow/filters/disk/noise_seed.glsl"
#include "shadow/filters/disk/stratified_disk.glsl"
#include "shadow/filters/pcf/texel_vote.glsl"
#include "shadow/filters/pcss/stands_before.glsl"
#include "shadow/filters/triangles/mesh_walk.glsl"
#include "shadow/filters/triangles/own_surface.glsl"
#include "shadow/filters/triangles/visited.glsl"
#include "shadow/filters/pcss/in_view.glsl"
#include "shadow/filters/soft_triangles/source_places.glsl"

// Taps of the search per octave: it looks at all scales alike, since a low caster's cone is a small part of a high
// one's.
const float kSearchTapsPerOctave = 4.0;
const int kMostSearchTaps = 28;
// Least radius of the search, texels: the four texels around the receiver show what is nearer.
const float kLeastSearch_texel = 0.5;
// Largest radius of the search in a lamp's map, as a share of the map's side.
const float kMostReach = 0.5;
// Distance aside, in widths of its cone, up to which a caster is tested: its triangle may reach into the cone.
const float kFarAside = 3.0;

// Taps around the receiver, farther and farther inward.
struct SearchSpiral {
    int taps;
    float reach;      // the widest cone, in depth
    float inward;     // by which each tap is nearer than the one before, as a power of 2
    float wider;      // by which every cone is wider, in depth: the pixel's area
    vec2 right, up;   // half axes of the source on the map, texels at depth 1 of the cone
};

// Returns a place of the source as texels from the receiver, at depth 1 of the cone.
vec2 on_map(SearchSpiral spiral, vec2 at) { return spiral.right * at.x + spiral.up * at.y; }

// Returns stands_before(), and 0 beyond a flat map.
float stands_in_map(ShadowPoint point, vec2 place, vec2 offset_texel) {
    float before = stands_before(point, place, offset_texel);
    return is_beyond_map(place + offset_texel) ? 0.0 : before;
}

vec2 spiral_offset(SearchSpiral spiral, int i) {
    return spiral.reach * exp2(-spiral.inward * float(i)) * on_map(spiral, on_circle(kGolden * float(i)));
}

#include "shadow/filters/soft_triangles/source_walk.glsl"

// Returns a half axis of the source on the map.
vec2 axis_on_map(ShadowPoint point, vec3 axis) {
    vec3 seen = in_view(point, axis);
    return (seen.xy + point.tangent * seen.z) * point.source_texel / max(light.radiance.w, 1e-30);
}

// Returns the source as the receiver sees it. Its axes are turned at random, as are the places on them.
SourcePlaces source_places(ShadowPoint point, float turn) {
    SourcePlaces source = source_without_places(point.position_ca);
    if (!kOnSquare) {
        vec2 turned = on_circle(turn);
        vec3 right = source.right * turned.x + source.up * turned.y;
        source.up = source.up * turned.x - source.right * turned.y;
        source.right = right;
    }
    source.above = ~places_below_one(dot(point.normal, source.middle), dot(point.normal, source.right), dot(point.normal, source.up));
    source.hidden = 0u;
    source.unknown = false;
    return source;
}

// Returns texels that show casters in the cone or near it.
StartTexels find_casters(ShadowPoint point, SourcePlaces source, float share) {
    FourTexels four = four_texels(point);
    bvec4 may = may_darken(point, four);
    StartTexels found;
    found.bits = (may[0] ? 1u : 0u) | (may[1] ? 2u : 0u) | (may[2] ? 4u : 0u) | (may[3] ? 8u : 0u);
    found.sure = found.bits;
    found.place = four.place;
    found.corner = four.corner;
    float texels = max(point.source_texel.x, point.source_texel.y) * source_stretch(point.tangent);
    float reach_texel = texels * (1.0 - clamp(point.reference, 0.0, 1.0));
    SearchSpiral spiral;
    float area_texel = receiver_radius_texel(point);
    spiral.wider = texels > 0.0 ? area_texel / texels : 0.0;
    reach_texel += texels > 0.0 ? area_texel : 0.0;
    reach_texel = min(reach_texel, kIsSun ? light.spread.w : kMostReach * shadow_map_size().x);
    float octaves = max(log2(max(reach_texel, kLeastSearch_texel) / kLeastSearch_texel), 0.0);
    spiral.taps = min(int(ceil(kSearchTapsPerOctave * octaves)), kMostSearchTaps);
    spiral.inward = octaves / max(float(spiral.taps), 1.0);
    spiral.reach = octaves > 0.0 ? reach_texel / texels * exp2(-spiral.inward * share) : 0.0;
    spiral.right = axis_on_map(point, source.right);
    spiral.up = axis_on_map(point, source.up);
    // Steps in place of spiral_offset().
    float all = 0.0, sum = 0.0, aside = spiral.reach, nearer = exp2(-spiral.inward);
    vec2 at = vec2(1.0, 0.0), turn = on_circle(kGolden);
    int i = 0;
    if (spiral.taps > 0) do {
        float before = stands_in_map(point, four.place, aside * on_map(spiral, at));
        float cones = before > 0.0 ? max(aside - spiral.wider, 0.0) / before : kFarAside;
        bool finds = cones < kFarAside;
        found.bits |= finds ? 16u << i : 0u;
        found.sure |= cones < 1.0 ? 16u << i : 0u;
        float weight = finds ? 1.0 / max(1.0, cones * cones * cones * cones) : 0.0;
        sum += weight * before;
        all += weight;
        aside *= nearer;
        at = vec2(at.x * turn.x - at.y * turn.y, at.x * turn.y + at.y * turn.x);
    } while (++i < spiral.taps);
    found.spiral = spiral;
    found.before = all > 0.0 ? sum / all : 0.0;
    return found;
}

// Returns places that texels hide which stand about `before` the receiver, in depth.
uint hidden_by_depth(ShadowPoint point, StartTexels found, bool wanted) {
    const float kSameCaster = 0.7;   // least share of the mean height at which a caster counts: it may lean away
    uint hidden = 0u;
    int i = 0;
    if (wanted) do {
        vec2 at = source_place_at(i);
        float stands = stands_in_map(point, found.place, found.before * on_map(found.spiral, at));
        hidden |= stands > found.before * min(length(at), kSameCaster) ? 1u << i : 0u;
    } while (++i < kPlaceCount);
    return hidden;
}

#ifdef LEAVE_UNDECIDED
// true where texels show casters, in the first draw of a light.
bool shadow_undecided = false;

float shadow_filter(ShadowPoint point) {
    vec2 seed = shadow_seed(point);
    StartTexels found = find_casters(point, source_places(point, seed.y), seed.x);
    shadow_undecided = shadow_undecided || found.bits != 0u;
    return 1.0;
}
#else
float shadow_filter(ShadowPoint point) {
    vec2 seed = shadow_seed(point);
    SourcePlaces source = source_places(point, seed.y);
    StartTexels found = find_casters(point, source, seed.x);
    blurred_texel = found.before * source_stretch(point.tangent) * point.source_texel;
    source = behind_triangles(point, found, source);
    source.hidden |= hidden_by_depth(point, found, source.unknown);
    return seen_share(source);
}
#endif
