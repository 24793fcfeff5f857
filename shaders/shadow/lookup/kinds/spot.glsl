// Spot light: one perspective view, or for a wide cone the faces of a cube around it. While one fades into the other,
// it has both, the faces first.
#include "shadow/lookup/kinds/map_2d.glsl"

vec3 from_anchor(int i, vec3 position_ca) { return position_ca + light.views[i].anchor_from_camera.xyz; }

// Returns a position from the light. The light stands behind the anchor, as far as the anchor lies along the view:
// where w is that of the origin. If the anchor is at the light, that is 0.
vec3 from_light(int i, vec3 position_ca) {
    return from_anchor(i, position_ca) - light.views[i].axis_back.xyz * light.views[i].map_from_anchor[3][3];
}

ShadowPoint point_in_view(int i, vec3 position_ca, vec3 normal, float error_m, float reach_texel) {
    ViewRecord view = light.views[i];
    vec3 position_aa = from_anchor(i, position_ca), position_la = from_light(i, position_ca);
    mat3 map_axes = mat3(view.axis_u.xyz, view.axis_v.xyz, view.axis_back.xyz);
    vec3 n_map = normal * map_axes;
    vec3 position_map = position_la * map_axes;
    float rounding_m = error_m + kept_off_m(view, position_ca) + kPositionRounding * length(position_aa);
    float plane_m = -dot(normal, position_la);
    float nearer_m = plane_m - carried_plane_m(plane_m, length(position_la), rounding_m);
    if (kReadsDepths) rounding_m += carried_error_m(vec2(view.axis_u.w, view.axis_v.w) * -position_map.z, abs(n_map.xy), -dot(normal, normalize(position_la)));
    vec2 spread = shadow_spread(vec2(view.axis_u.w, view.axis_v.w) * -position_map.z, length(position_ca));
    float reach = reach_texel + max(spread.x, spread.y);
    Bias bias = perspective_bias(view, n_map, abs(n_map.xy), max(-n_map.z, 0.0), position_map, reach, rounding_m);
    if (kManualBias && light.options.y != 0) {
        bias = manual_bias(perspective_place(view, normal, position_la, -position_map.z));
        nearer_m = bias.along_normal_m;
    }
    vec3 moved = position_aa + normal * bias.along_normal_m;
    ShadowPoint point = point_2d(i, view.map_from_anchor * vec4(moved, 1.0), bias.depth, 0.0);
    point.source_texel = lamp_source_texel(view);
    point.tangent = vec2(position_map.x, position_map.y) / -position_map.z;
    point.spread_texel = spread;
    point.carried_aa = position_aa + normal * nearer_m;
    point.position_ca = off_proxies(view, position_ca, normal);
    point.facts = facts_perspective(view, bias, length(position_la), -position_map.z);
    return point;
}

float shadow_share(ShadowPoint point) {
    ViewRecord view = light.views[point.view];
    return perspective_share(point.reference, 1.0, share_range(view.numeric.z, view.axis_back.w, 1.0));
}
float depth_at_share(ShadowPoint point, float share) {
    ViewRecord view = light.views[point.view];
    return perspective_depth(share, 1.0, share_range(view.numeric.z, view.axis_back.w, 1.0));
}

// Returns the face that looks most nearly along the direction; -1: none. A face without a view has no caster that is
// seen.
int face_toward(int faces, vec3 position_la) {
    int best = -1;
    float deepest = 0.0;
    for (int i = 0; i < faces; ++i) {
        float z_m = -dot(position_la, light.views[i].axis_back.xyz);
        if (z_m > deepest) {
            deepest = z_m;
            best = i;
        }
    }
    return best;
}

ShadowPoint point_in_view_or_none(int i, vec3 position_ca, vec3 normal, float error_m, float reach_texel) {
    ShadowPoint point = point_in_view(max(i, 0), position_ca, normal, error_m, reach_texel);
    point.covered = point.covered && i >= 0;
    return point;
}

bool has_single_view() { return light.cone.z < 1.0 && (light.cone.z == 0.0 || (light.options.w & 32) != 0); }

// Returns the view that serves a place; -1: none.
int serving_view(int lookup, vec3 position_ca) {
    int view = light.options.x - 1;
    if (lookup > 0 || !has_single_view()) view = face_toward(light.options.x - lookup, from_light(0, position_ca));
    return view;
}

// Returns the first view that may serve a place, and the last.
ivec2 serving_views(vec3 position_ca) {
    int view = serving_view(0, position_ca);
    return ivec2(view, view);
}

ShadowPoint shadow_point(int lookup, vec3 position_ca, vec3 normal, float error_m, float reach_texel) {
    return point_in_view_or_none(serving_view(lookup, position_ca), position_ca, normal, error_m, reach_texel);
}

// Returns the share of the single view; 0 where either it or the faces have no view.
float shadow_fade_share(ShadowPoint first, float reach_texel) {
    return has_single_view() && light.options.x > 1 ? light.cone.z : 0.0;
}

// Returns true: a face without a view darkens nothing, as when the faces are alone.
bool shadow_fades_into(ShadowPoint second) { return true; }
