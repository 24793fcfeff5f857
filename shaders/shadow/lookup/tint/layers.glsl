// Tint of a light by the layers of its translucent casters (systems/shadow/maps/tint_maps.h). It is the share of the
// light that passes through all of them between it and a place, per channel.
#include "common/bindings.glsl"
#include "common/float_rounding.glsl"
#include "shadow/lookup/row_flags.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/kinds/cascade_choice.glsl"
#include "shadow/lookup/plane_in_map.glsl"
#include "shadow/passes/tint/absorbance.glsl"
layout(binding = kTintDepthUnit) uniform sampler2DArray tint_depths;   // four layers, nearest to the light first; 0: none
layout(binding = kTintUnit) uniform sampler2DArray tint_absorbances;   // four in a row per layer of the map: each up to that layer
const bool kTinted = true;

struct TintPlace {
    int view;            // -1: no map holds the place
    vec3 position_va;    // from the view's anchor
    vec4 projected;
    vec3 map;            // u, v, reversed depth
    float inside;        // distance from the map's border, as a share of its edge; below 0: beyond it
};

TintPlace place_in_tint(int view, vec3 position_ca) {
    TintPlace place;
    place.view = view;
    place.position_va = position_ca + light.views[view].anchor_from_camera.xyz;
    place.projected = light.views[view].map_from_anchor * vec4(place.position_va, 1.0);
    place.map = place.projected.xyz / place.projected.w;
    vec2 inside = min(place.map.xy, 1.0 - place.map.xy);
    // A cascade draws only what can darken its own depth range: places before it are served by the next one.
    bool in_depth = place.projected.w > 0.0 && place.map.z >= 0.0 && (!kIsSun || place.projected.z <= place.projected.w);
    place.inside = in_depth ? min(inside.x, inside.y) : -1.0;
    return place;
}

// Returns the place in the map that serves it. It is the first of a sun's maps with the place in it, or the map of a lamp
// that looks most nearly toward it.
TintPlace tint_place(vec3 position_ca) {
    const float kSeam = -1.0e-4;   // a direction between two faces of a cube may round to neither
    TintPlace best;
    best.view = -1;
    best.inside = kSeam;
    bool by_distance = kIsSun && light.options.z != 0;
    for (int view = by_distance ? cascade_at(fitted_distance_m(position_ca)) : 0; view < light.options.x; ++view) {
        if (kIsSun && best.view >= 0) break;
        TintPlace place = place_in_tint(view, position_ca);
        if (place.inside > best.inside) best = place;
    }
    return best;
}

// Returns what passes through the surfaces of one texel before a receiver of that depth.
vec3 passed_texel(ivec2 texel, int layer, float receiver_depth) {
    vec4 depths = texelFetch(tint_depths, ivec3(texel, layer), 0);
    int before = 0;
    for (int i = 0; i < 4; ++i) before += depths[i] > receiver_depth ? 1 : 0;
    if (before == 0) return vec3(1.0);
    return transmittance_of(texelFetch(tint_absorbances, ivec3(texel, 4 * layer + before - 1), 0).rgb);
}

// Returns the share of the light that passes. The receiver's plane is compared at the middle of each texel, so that a
// pane does not tint itself. The four texels around the place are weighted as by a linear sampler.
vec3 shadow_tint(vec3 position_ca, vec3 normal, float error_m) {
    TintPlace place = tint_place(position_ca);
    if (place.view < 0) return vec3(1.0);
    ViewRecord view = light.views[place.view];
    int layer = int(view.numeric.w);
    if (layer < 0) return vec3(1.0);
    MapGradients around = map_gradients(view.map_from_anchor, place.map);
    float facing = facing_ray(around, normal);
    float size_texel = float(textureSize(tint_depths, 0).x);
    vec3 over_u = step_over_u(around, normal, facing, 1.0 / size_texel), over_v = step_over_v(around, normal, facing, 1.0 / size_texel);
    vec2 slope = vec2(dot(over_u, around.along_depth), dot(over_v, around.along_depth));
    // How far the plane may lie nearer to the light (docs/explanation/bias.md): by the place's own error, the normal's
    // over one texel, and snapped corners.
    float w = place.projected.w;
    float off_m = error_m + max(view.numeric.y, 0.0) + kPositionRounding * (abs(place.position_va.x) + abs(place.position_va.y) + abs(place.position_va.z)) +
                  kNormalError_rad * w * (length(over_u) + length(over_v));
    float depth_per_m = abs(dot(around.along_depth, around.ray) / (w * facing));
    float nearer = view.numeric.x + 7.0 * kUnitRoundoff * place.map.z + off_m * depth_per_m + kRasterSnap_texel * (abs(slope.x) + abs(slope.y));
    vec2 at_texel = place.map.xy * size_texel - 0.5;
    vec2 corner = floor(at_texel), share = at_texel - floor(at_texel);
    vec3 taken = vec3(0.0);   // where nothing is in the way it is exactly 0
    for (int i = 0; i < 4; ++i) {
        vec2 step_texel = vec2(float(i & 1), float(i >> 1));
        vec2 texel = clamp(corner + step_texel, 0.0, size_texel - 1.0);
        vec2 weights = mix(1.0 - share, share, step_texel);
        float depth = place.map.z + nearer + dot(slope, texel - at_texel);
        taken += weights.x * weights.y * (1.0 - passed_texel(ivec2(texel), layer, depth));
    }
    return max(1.0 - taken, 0.0);
}
