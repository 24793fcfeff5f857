// Place of a receiver in a light's map of sheets, with bounds on its error. Requires the light's kind, with
// SHADOW_DEPTHS; its serving_views() names the views to read. It reads no more of their records than needed, because
// software devices fetch every number of a uniform block again for each few pixels.
#include "common/bindings.glsl"
#include "shadow/filters/exact/error_margins.glsl"
layout(binding = kBoundsUnit) uniform sampler2DArray sheet_bounds;   // nearest contour, departure

// Farthest that a receiver's place may lie from its texel's middle: what kTexelHalf leaves beside the rasteriser's
// 2^-8.
const float kMostAside_texel = 0.508;

struct SheetPlace {
    bool is_held;    // the view's map contains it
    bool is_known;
    bool is_open;    // nothing casts into that map
    int view;
    ivec3 texel;
    float depth, error;
    vec2 at_texel;   // from the map's corner, and how far off that may be
    float off_texel;
    vec3 direction;  // from the light, turned back; of a cube
};

float sheet_size() { return float(textureSize(sheet_bounds, 0).x); }

// Returns the place in a view's map. It is known if it surely lies in its texel, and its depth in [0, 1]. The caller
// sets is_held and is_open.
SheetPlace place_of(vec2 place, float error_texel, int view, int layer, float depth, float error) {
    vec2 texel = clamp(floor(place), 0.0, sheet_size() - 1.0);
    vec2 aside = abs(place - texel - 0.5);
    SheetPlace found;
    found.is_known = max(aside.x, aside.y) + kRoundings * error_texel <= kMostAside_texel && depth >= 0.0 && depth <= 1.0;
    found.is_held = found.is_open = false;
    found.view = view;
    found.texel = ivec3(ivec2(texel), layer);
    found.depth = depth;
    found.error = kRoundings * error;
    found.at_texel = place;
    found.off_texel = kRoundings * error_texel;
    return found;
}

#ifdef SHADOW_CUBE
SheetPlace sheet_place(vec3 position_ca, float error_m) {
    ViewRecord view = light.views[0];
    vec3 position_la = position_ca + view.anchor_from_camera.xyz;
    vec3 p = turned_back(position_la);
    const float kTurnUnits = 20.0;   // rounding of the turn, and of the faces' own axes and matrices
    float off_m = error_m + kUnitRoundoff * (largest(view.anchor_from_camera.xyz) + kTurnUnits * largest(p));
    mat3 axes = face_axes(p);
    float z_m = largest(p);
    vec2 tangent = vec2(dot(p, axes[0]), dot(p, axes[1])) / z_m;
    float alpha = view.numeric.z, beta = view.axis_back.w;
    float error = beta * off_m / (z_m * z_m) + kProjectedUnits * kUnitRoundoff * (abs(alpha) + beta / z_m);
    vec2 place_texel = (tangent * 0.5 + 0.5) * sheet_size();
    SheetPlace place = place_of(place_texel, sheet_size() * off_m / z_m, 0, face_of(p), alpha + beta / z_m, error);
    place.is_known = place.is_known && z_m > 2.0 * off_m;
    place.is_held = place.is_known;
    place.is_open = place.is_known && !is_drawn(p);
    place.direction = p;
    return place;
}

// Returns the first depth at the texel's middle.
float first_depth(SheetPlace place) {
    vec2 tangent = (vec2(place.texel.xy) + 0.5) / sheet_size() * 2.0 - 1.0;
    return textureLod(shadow_map, face_axes(place.direction) * vec3(tangent, -1.0), 0.0).x;
}
#else
SheetPlace place_in_view(int i, vec3 position_ca, float error_m) {
    vec3 anchor_from_camera = light.views[i].anchor_from_camera.xyz;
    mat4 m = light.views[i].map_from_anchor;
    vec3 p = position_ca + anchor_from_camera;
    vec3 off_m = error_m + kUnitRoundoff * (abs(anchor_from_camera) + abs(p));
    // The map's own matrix is rounded apart from this one: a unit more.
    const float kUnits = kProjectedUnits + 2.0;
    vec4 summed = vec4(off_m + kUnits * kUnitRoundoff * abs(p), kUnits * kUnitRoundoff);
    vec4 projected = m * vec4(p, 1.0), off = absolute(m) * summed;
    bool is_before = true;   // along parallel rays w is 1
    vec3 map = projected.xyz, error = off.xyz;
    if (!kIsSun) {
        is_before = projected.w > 16.0 * off.w;
        map = projected.xyz / projected.w;
        error = (off.xyz + abs(map) * off.w) / projected.w;
    }
    int layer = int(light.views[i].numeric.w);
    SheetPlace place = place_of(map.xy * sheet_size(), max(error.x, error.y) * sheet_size(), i, layer, map.z, error.z);
    place.is_held = is_before && all(lessThanEqual(abs(map - 0.5), 0.5 - kRoundings * error));
    place.is_known = place.is_known && place.is_held;
    place.is_open = place.is_held && layer < 0;
    return place;
}

SheetPlace sheet_place(vec3 position_ca, float error_m) {
    ivec2 views = serving_views(position_ca);
    SheetPlace place;
    do {
        place = place_in_view(max(views.x, 0), position_ca, error_m);
    } while (!place.is_held && views.x++ < views.y);
    place.is_known = place.is_known && views.x >= 0;
    place.is_open = place.is_open && views.x >= 0;
    return place;
}

// Returns the first depth at the texel's middle.
float first_depth(SheetPlace place) { return texelFetch(shadow_map, place.texel, 0).x; }
#endif
