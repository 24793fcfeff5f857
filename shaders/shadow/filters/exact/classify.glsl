// Classification of a receiver as certainly lit, certainly dark or uncertain, by conservative bounds on all that its
// texel covers (docs/explanation/exact_proof.md). Requires the light's kind, with SHADOW_DEPTHS.
#include "common/bindings.glsl"
#include "shadow/filters/exact/map_position.glsl"
layout(binding = kSecondDepthUnit) uniform sampler2DArray sheet_second;   // next depths behind those of shadow_map, of other triangles

const float kNoReach = 3.0e38;        // kNoEnd: all the way
const float kReachUnits = 16.0;       // kStoredUnits, and the rounding of a reach's own computation
const float kMostFloorShare = 0.5;    // largest share for which a texel bounds a reach; wider texels do not
const int kCertainlyLit = 0, kCertainlyDark = 1, kUncertain = 2;

// Returns by how much facets that are not drawn may depart from a depth, as a share of that depth less the far end's:
// FlatFacetTest. A sun's map is cleared to it.
float sheet_floor_share(SheetPlace place) {
    if (kIsSun) return 0.0;
    // Along a walk 1/z changes by no more than this share of itself in half a texel.
    float share = 0.5 * kFloorTangent * max(light.views[place.view].axis_u.w, light.views[place.view].axis_v.w);
    return kDepartureFactor * share * (1.0 + 2.0 * share);
}

float sheet_floor(SheetPlace place, float depth) {
    return kIsSun ? 0.0 : sheet_floor_share(place) * (depth - light.views[place.view].numeric.z);
}

// Returns the verdict on a place. `receiver_casts`: the receiver's own surface is among the map's casters. If not, the
// nearest caster, too, may not lie before it.
int sheet_verdict(SheetPlace place, bool receiver_casts) {
    if (place.is_open) return kCertainlyLit;
    if (!place.is_known) return kUncertain;
    float first = first_depth(place), second = texelFetch(sheet_second, place.texel, 0).x;
    vec2 bounds = texelFetch(sheet_bounds, place.texel, 0).xy;
    float nearest = max(first, place.depth);
    float contour = bounds.x;
    float off = max(bounds.y, sheet_floor(place, nearest)) + place.error + kRoundings * kStoredUnits * kUnitRoundoff * nearest;
    if (first - off > max(place.depth, contour)) return kCertainlyDark;
    return place.depth - off > max(receiver_casts ? second : first, contour) ? kCertainlyLit : kUncertain;
}

// Returns how far toward the light anything may stand before a receiver, as a share of that way (sun: metres). It
// stands no farther than what its texel shows, or where a sheet ends there, and what sheets depart by from that.
float sheet_reach(SheetPlace place) {
    if (place.is_open) return 0.0;
    if (!place.is_known) return kNoReach;
    vec2 bounds = texelFetch(sheet_bounds, place.texel, 0).xy;
    float shown = max(first_depth(place), bounds.x);
    float rounding = place.error + kRoundings * kReachUnits * kUnitRoundoff * max(shown, place.depth);
    float nearest, reach;
    if (kIsSun) {
        nearest = shown + bounds.y + rounding;
        reach = (nearest - place.depth) * light.views[place.view].axis_back.w;
    } else {
        // The bound is of what stands there, not of what is shown: d departs by no more than share * (d - alpha).
        float share = min(sheet_floor_share(place), kMostFloorShare), alpha = light.views[place.view].numeric.z;
        nearest = shown + max(bounds.y, (shown - alpha) * share / (1.0 - share)) + rounding;
        reach = share < kMostFloorShare ? (nearest - place.depth + rounding) / (nearest - alpha) : kNoReach;
    }
    // What lies before the near plane counts as on it.
    return nearest < 1.0 ? max(reach, 0.0) * (1.0 + kRoundings * kReachUnits * kUnitRoundoff) : kNoReach;
}
