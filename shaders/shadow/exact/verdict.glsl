// Whether a receiver is certainly lit or certainly dark, by what a texel's sheets say of all of it (docs/exact.md). Bring the
// light's kind first, with SHADOW_DEPTHS; its ShadowPoint says which view serves the receiver.
#include "shadow/exact/margins.glsl"
layout(binding = 7) uniform sampler2DArray sheet_second;   // next depths behind those of shadow_map, of other triangles
layout(binding = 8) uniform sampler2DArray sheet_bounds;   // nearest contour, departure

const float kNoReach = 3.0e38;        // kNoEnd: all the way
const float kReachUnits = 16.0;       // kStoredUnits, and what a reach is computed by
const float kMostFloorShare = 0.5;    // of wider texels nothing is said
const int kCertainlyLit = 0, kCertainlyDark = 1, kUncertain = 2;
// How far from its texel's middle a receiver's place may lie: what kTexelHalf has left beside the rasteriser's 2^-8.
const float kMostAside_texel = 0.508;

struct SheetPlace {
    bool is_known;
    ivec3 texel;
    float depth, error;
    vec2 at_texel;   // from the map's corner, and how far off that may be
    float off_texel;
};

// As far as the middle of its texel tells.
SheetPlace place_of(vec2 place, float error_texel, int layer, float depth, float error) {
    float size = float(textureSize(sheet_bounds, 0).x);
    vec2 texel = clamp(floor(place), 0.0, size - 1.0);
    vec2 aside = abs(place - texel - 0.5);
    bool is_known = max(aside.x, aside.y) + kRoundings * error_texel <= kMostAside_texel && depth >= 0.0 && depth <= 1.0;
    return SheetPlace(is_known, ivec3(ivec2(texel), layer), depth, kRoundings * error, place, kRoundings * error_texel);
}

#ifdef LIGHT_POINT
SheetPlace sheet_place(ShadowPoint point, vec3 position_ca, float error_m) {
    ViewRecord view = light.views[0];
    vec3 position_la = position_ca + view.anchor_from_camera.xyz;
    vec3 p = turned_back(position_la);
    const float kTurnUnits = 20.0;   // the turn, and the faces' own axes and matrices
    float off_m = error_m + kUnitRoundoff * (largest(view.anchor_from_camera.xyz) + kTurnUnits * largest(p));
    mat3 axes = face_axes(p);
    float z_m = largest(p), size = float(textureSize(sheet_bounds, 0).x);
    vec2 tangent = vec2(dot(p, axes[0]), dot(p, axes[1])) / z_m;
    float alpha = view.numeric.z, beta = view.axis_back.w;
    float error = beta * off_m / (z_m * z_m) + kProjectedUnits * kUnitRoundoff * (abs(alpha) + beta / z_m);
    SheetPlace place = place_of((tangent * 0.5 + 0.5) * size, size * off_m / z_m, face_of(p), alpha + beta / z_m, error);
    place.is_known = place.is_known && z_m > 2.0 * off_m;
    return place;
}

// Whether it lies in a face that shows nothing, beyond doubt.
bool is_in_the_open(ShadowPoint point, SheetPlace place) {
    return place.is_known && (light.options.w >> place.texel.z & 1) == 0;
}

float first_depth(ShadowPoint point, SheetPlace place) {
    vec3 p = turned_back(point.position_ca + light.views[0].anchor_from_camera.xyz);
    vec2 tangent = (vec2(place.texel.xy) + 0.5) / float(textureSize(sheet_bounds, 0).x) * 2.0 - 1.0;
    return textureLod(shadow_map, face_axes(p) * vec3(tangent, -1.0), 0.0).x;
}
#else
SheetPlace sheet_place(ShadowPoint point, vec3 position_ca, float error_m) {
    ViewRecord view = light.views[point.view];
    vec3 p = position_ca + view.anchor_from_camera.xyz;
    vec3 off_m = error_m + kUnitRoundoff * (abs(view.anchor_from_camera.xyz) + abs(p));
    mat4 m = view.map_from_anchor;
    vec4 projected = m * vec4(p, 1.0);
    // The map's own matrix is rounded apart from this one: a unit more.
    const float kUnits = kProjectedUnits + 2.0;
    vec4 summed = vec4(off_m + kUnits * kUnitRoundoff * abs(p), kUnits * kUnitRoundoff);
    vec4 off = mat4(abs(m[0]), abs(m[1]), abs(m[2]), abs(m[3])) * summed;
    vec3 map = projected.xyz / projected.w;
    vec3 error = (off.xyz + abs(map) * off.w) / projected.w;
    float size = float(textureSize(sheet_bounds, 0).x);
    SheetPlace place = place_of(map.xy * size, max(error.x, error.y) * size, int(point.layer), map.z, error.z);
    place.is_known = place.is_known && point.covered && projected.w > 16.0 * off.w;
    return place;
}

bool is_in_the_open(ShadowPoint point, SheetPlace place) { return point.covered && point.layer < 0.0; }

float first_depth(ShadowPoint point, SheetPlace place) { return texelFetch(shadow_map, place.texel, 0).x; }
#endif

ViewRecord sheet_view(ShadowPoint point) {
#ifdef LIGHT_POINT
    return light.views[0];
#else
    return light.views[point.view];
#endif
}

// By how much facets that are not drawn may depart from a depth, FlatFacets, as a share of that depth less the far end's; the map of
// a sun is cleared to it.
float sheet_floor_share(ViewRecord view) {
#ifdef LIGHT_DIRECTIONAL
    return 0.0;
#else
    // Along a walk 1/z changes by no more than this share of itself in half a texel.
    float share = 0.5 * kFloorTangent * max(view.axis_u.w, view.axis_v.w);
    return kDepartureFactor * share * (1.0 + 2.0 * share);
#endif
}

float sheet_floor(ShadowPoint point, float depth) {
    ViewRecord view = sheet_view(point);
    return sheet_floor_share(view) * (depth - view.numeric.z);
}

// `receiver_casts`: the receiver's own surface is among the casters of the map; else the nearest of those, too, may not lie
// before it.
int sheet_verdict(ShadowPoint point, vec3 position_ca, float error_m, bool receiver_casts) {
    SheetPlace place = sheet_place(point, position_ca, error_m);
    if (is_in_the_open(point, place)) return kCertainlyLit;
    if (!place.is_known) return kUncertain;
    float first = first_depth(point, place), second = texelFetch(sheet_second, place.texel, 0).x;
    vec2 bounds = texelFetch(sheet_bounds, place.texel, 0).xy;
    float nearest = max(first, place.depth);
    float contour = bounds.x;
    float off = max(bounds.y, sheet_floor(point, nearest)) + place.error + kRoundings * kStoredUnits * kUnitRoundoff * nearest;
    if (first - off > max(place.depth, contour)) return kCertainlyDark;
    return place.depth - off > max(receiver_casts ? second : first, contour) ? kCertainlyLit : kUncertain;
}

// How far toward the light anything may stand before a receiver, as a share of that way (a sun: in metres): no farther than what its
// texel shows, or where a sheet ends there, and what sheets depart by from that.
float sheet_reach(ShadowPoint point, vec3 position_ca, float error_m) {
    SheetPlace place = sheet_place(point, position_ca, error_m);
    if (!place.is_known) return kNoReach;
    ViewRecord view = sheet_view(point);
    vec2 bounds = texelFetch(sheet_bounds, place.texel, 0).xy;
    float shown = max(first_depth(point, place), bounds.x);
    float rounding = place.error + kRoundings * kReachUnits * kUnitRoundoff * max(shown, place.depth);
#ifdef LIGHT_DIRECTIONAL
    float nearest = shown + bounds.y + rounding;
    float reach = (nearest - place.depth) * view.axis_back.w;
#else
    // Of what stands there, not of what is shown: d departs by no more than share * (d - alpha).
    float share = min(sheet_floor_share(view), kMostFloorShare), alpha = view.numeric.z;
    float nearest = shown + max(bounds.y, (shown - alpha) * share / (1.0 - share)) + rounding;
    float reach = share < kMostFloorShare ? (nearest - place.depth + rounding) / (nearest - alpha) : kNoReach;
#endif
    // What lies before the near plane counts as on it.
    return nearest < 1.0 ? max(reach, 0.0) * (1.0 + kRoundings * kReachUnits * kUnitRoundoff) : kNoReach;
}
