// Cascades of a directional light, near to far. Requires map_2d.glsl, cascade_bias() and cascade_range_m().
#include "shadow/lookup/kinds/cascade_choice.glsl"

ShadowPoint point_in_cascade(int i, vec3 position_ca, vec3 normal, float error_m, float reach_texel) {
    ViewRecord view = light.views[i];
    vec3 position_la = position_ca + view.anchor_from_camera.xyz;
    vec3 n_map = vec3(dot(normal, view.axis_u.xyz), dot(normal, view.axis_v.xyz), dot(normal, view.axis_back.xyz));
    float rounding_m = error_m + kept_off_m(view, position_ca) + kPositionRounding * (abs(position_la.x) + abs(position_la.y) + abs(position_la.z));
    vec2 spread = shadow_spread(vec2(view.axis_u.w, view.axis_v.w), length(position_ca));
    float reach = reach_texel + max(spread.x, spread.y);
    float nearer_m = taken(rounding_m);
    if (kReadsDepths) rounding_m += carried_error_m(vec2(view.axis_u.w, view.axis_v.w) * (cascade_range_m(view, position_la) / view.axis_back.w), abs(n_map.xy), n_map.z);
    Bias bias = cascade_bias(view, position_la, normal, n_map, reach, rounding_m);
    if (kManualBias && light.options.y != 0) {
        bias = manual_bias(orthographic_place(view, n_map.z, cascade_range_m(view, position_la)));
        nearer_m = bias.along_normal_m;
    }
    vec3 moved = position_la + normal * bias.along_normal_m;
    vec4 projected = view.map_from_anchor * vec4(moved, 1.0);
    vec2 source_texel = sun_source_texel(view);
    float reads_texel = read_texel(reach) + source_reach_texel(source_texel, vec2(0.0), projected.z / projected.w);
    ShadowPoint point = point_2d(i, projected, bias.depth, reads_texel);
    point.source_texel = source_texel;
    point.spread_texel = spread;
    point.carried_aa = position_la + normal * nearer_m;
    point.position_ca = off_proxies(view, position_ca, normal);
    point.facts = facts_orthographic(view, bias, cascade_range_m(view, position_la));
    // A cascade draws only what can darken its own depth range: points before it are served by the next one.
    point.covered = point.covered && projected.z <= projected.w;
    return point;
}

float shadow_share(ShadowPoint point) { return orthographic_share(point.reference); }
float depth_at_share(ShadowPoint point, float share) { return 1.0 - share; }

// Returns 0 up to the last part of a cascade's slice, then a share that rises to 1 where that ends.
float share_between(float start_m, float end_m, float distance_m) {
    return end_m > start_m ? clamp((distance_m - start_m) / (end_m - start_m), 0.0, 1.0) : 1.0;
}

// Returns a share that rises to 1 toward the border of the map. nearest: distance from it, in parts of the map.
float share_near_border(float nearest, float blend) { return clamp(1.0 - nearest / blend, 0.0, 1.0); }

float share_at(int i, float distance_m) {
    return share_between(light.views[i].numeric.z, light.views[i].anchor_from_camera.w, distance_m);
}

float share_toward_border(ShadowPoint point) {
    vec3 inside = min(point.map, 1.0 - point.map);
    vec2 reads = point.reads_texel * point.texel_uv;
    return share_near_border(min(min(inside.x - reads.x, inside.y - reads.y), inside.z), light.bias.y);
}

// Returns the first cascade that may serve a place, and the last. The first of these with the place in its map serves it.
ivec2 serving_views(vec3 position_ca) {
    return ivec2(light.options.z != 0 ? cascade_at(fitted_distance_m(position_ca)) : 0, light.options.x - 1);
}

// Cascade of the last lookup. A second lookup starts after it.
int found_cascade = -1;

ShadowPoint shadow_point(int lookup, vec3 position_ca, vec3 normal, float error_m, float reach_texel) {
    ivec2 views = serving_views(position_ca);
    if (lookup == 0) found_cascade = views.x - 1;
    ShadowPoint point;
    do {
        ++found_cascade;
        point = point_in_cascade(found_cascade, position_ca, normal, error_m, reach_texel);
    } while (!point.covered && found_cascade < views.y);
    return point;
}

float shadow_fade_share(ShadowPoint first, float reach_texel) {
    if (!first.covered || light.bias.y <= 0.0 || found_cascade + 1 >= light.options.x) return 0.0;
    float share = share_at(found_cascade, fitted_distance_m(first.position_ca));
    // What a map holds beyond its slice it serves up to its border.
    return light.options.z != 0 ? share : min(share, share_toward_border(first));
}

// Returns whether the next cascade's map holds the point. Where it does not, there is nothing to fade into.
bool shadow_fades_into(ShadowPoint second) { return second.covered; }
