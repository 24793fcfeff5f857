// Point light: a cube of up to six perspective views with common near and far. A face stores projected depth of its own
// axis, so the lookup needs only the largest coordinate, z. SHADOW_CUBE_MAP names the file that reads the map.
#define SHADOW_CUBE 1
#include "shadow/lookup/row_flags.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/bias/automatic.glsl"
#include "shadow/lookup/bias/manual.glsl"
#include "shadow/lookup/lookup_debug.glsl"
#include "shadow/lookup/tap_radius.glsl"
#include "shadow/lookup/light_size.glsl"
#include "shadow/lookup/cube_faces.glsl"
#include "shadow/passes/prefilter/linear_distance.glsl"

struct ShadowPoint {
    bool covered;
    vec3 position;        // from the light, after the bias moved it, metres
    vec3 step_u, step_v;  // one texel on the receiver's face, at its distance, metres
    float bias_depth;
    float reference;      // biased depth
    vec2 slope;           // slope of the receiver's plane: reversed depth per texel along u and v
    float plane_m;        // the light's distance from the plane that is carried to other texels
    vec3 plane;           // the receiver's plane, where dot(plane, position) is 1, if taps are compared on it
    vec2 spread_texel;    // half-width of a disk of taps
    vec2 source_texel;    // see shadow/lookup/light_size.glsl
    vec2 tangent;         // tangent of its direction along the face's axes
    float reach_texel;    // reach that the bias serves
    vec3 position_ca;     // from the camera's anchor, as it was given
    float error_m;        // how far position_ca may be off, metres
    vec3 normal;          // the receiver's
    LookupFacts facts;
};

// Returns whether the face that a direction falls on was drawn. A face that was not has no caster that is seen, and may
// hold anything.
bool is_drawn(vec3 direction) { return (light.options.w >> face_of(direction) & 1) != 0; }

// Turns a vector from the world's axes to the cube's.
vec3 turned_back(vec3 v) {
    vec3 axis = vec3(light.cone.x, light.cone.y, light.cone.z);
    return v + 2.0 * cross(axis, cross(axis, v) - light.cone.w * v);
}

#include SHADOW_CUBE_MAP

// Returns the slope of the plane that is carried to other texels. 1 / z is linear in the tangents on any plane: see
// perspective_bias().
vec2 shadow_slope(ShadowPoint point, vec3 normal_ws) {
    ViewRecord view = light.views[0];
    vec3 n_map = turned_back(normal_ws) * face_axes(point.position);
    return vec2(n_map.x, n_map.y) * (-view.axis_back.w * view.axis_u.w / point.plane_m);
}

// Returns how much longer the way from the light is than its part along the face's axis: the least within reach.
float shadow_stretch(ShadowPoint point) {
    vec3 direction = point.position / largest(point.position);
    float stretch = length(direction);
    float aside = abs(direction.x) + abs(direction.y) + abs(direction.z) - 1.0;
    return max(stretch - point.reach_texel * light.views[0].axis_u.w * aside / stretch, 1.0);
}

float shadow_share(ShadowPoint point) {
    ViewRecord view = light.views[0];
    return perspective_share(point.reference, shadow_stretch(point), share_range(view.numeric.z, view.axis_back.w, kCubeCorner));
}

float depth_at_share(ShadowPoint point, float share) {
    ViewRecord view = light.views[0];
    return perspective_depth(share, shadow_stretch(point), share_range(view.numeric.z, view.axis_back.w, kCubeCorner));
}

// Returns the reach that the bias serves near a seam. What the neighbour stores is up to half a texel of its own beside
// the middle that is read.
float seam_texel(float reach_texel) { return kReadsDepths ? max(reach_texel, 0.5) : reach_texel; }

bool may_be_dark(ShadowPoint point) { return point.covered; }

// Returns the face that serves the point, in OpenGL's order; -1: none.
int shadow_layer(ShadowPoint point) {
    vec3 back = face_axes(point.position)[2];
    int face = int(dot(abs(back), vec3(0.0, 2.0, 4.0))) + (back.x + back.y + back.z > 0.0 ? 1 : 0);
    return point.covered && is_drawn(point.position) ? face : -1;
}

// Returns where the point lies in its face, texels from a corner.
vec2 shadow_texel(ShadowPoint point) {
    float scale = 1.0 / largest(point.position);   // against overflow of squares
    vec3 position = point.position * scale, u = point.step_u * scale, v = point.step_v * scale;
    vec2 from_middle = vec2(dot(position, u) / dot(u, u), dot(position, v) / dot(v, v));
    return from_middle + 0.5 * shadow_map_size();
}

// Returns how far the point's place in its face moves, texels, as the receiver moves by a small step, metres.
vec2 texels_moved(ShadowPoint point, vec3 step_m) {
    vec3 in_face = turned_back(step_m) * face_axes(point.position);
    return (in_face.xy + point.tangent * in_face.z) / point.facts.texel_m;
}

// Returns the tangent of a texel's side: how much nearer to the light an offset along a direction brings a tap.
float shadow_texel_tan() { return light.views[0].axis_u.w; }

ShadowPoint shadow_point(int lookup, vec3 position_ca, vec3 normal_ws, float error_m, float reach_texel) {
    ViewRecord view = light.views[0];
    vec3 position_la = turned_back(position_ca + view.anchor_from_camera.xyz);
    vec3 normal = turned_back(normal_ws);
    mat3 map_axes = face_axes(position_la);
    vec3 axis_u = map_axes[0], axis_v = map_axes[1];
    float rounding_m = error_m + kept_off_m(view, position_ca) + kPositionRounding * length(position_la);
    // Near a seam some taps land on the neighbour. Its axes see the plane's other tangents: all three count.
    vec3 n_map = normal * map_axes;
    float z_m = largest(position_la);
    float second = max(abs(dot(position_la, axis_u)), abs(dot(position_la, axis_v)));
    // The neighbour's texels are larger by the share that the tap lies beyond the seam.
    vec2 tangents = abs(n_map.xy);
    float leaving = max(-n_map.z, 0.0);
    vec2 spread = shadow_spread(vec2(view.axis_u.w, view.axis_v.w) * z_m, length(position_ca));
    float reach = reach_texel + max(spread.x, spread.y);
    vec2 source_texel = lamp_source_texel(view);
    vec2 tangent = vec2(dot(position_la, axis_u), dot(position_la, axis_v)) / z_m;
    float reads_texel = read_texel(reach) + source_reach_texel(source_texel, tangent, view.numeric.z + view.axis_back.w / z_m);
    float beyond = (reads_texel + 1.0) * view.axis_u.w;
    if (second > z_m * (1.0 - 2.0 * beyond)) {
        leaving = max(leaving, max(tangents.x, tangents.y));
        tangents = (tangents + abs(n_map.z)) * (1.0 + beyond);
        reach = seam_texel(reach);
    }
    float distance_m = length(position_la), plane_m = -dot(normal, position_la);
    float carried_m = carried_plane_m(plane_m, distance_m, rounding_m);
    if (kReadsDepths)
        rounding_m += carried_error_m(vec2(view.axis_u.w * z_m), tangents, -dot(normal, normalize(position_la)));
    Bias bias = perspective_bias(view, n_map, tangents, leaving, position_la * map_axes, reach, rounding_m);
    if (kManualBias && light.options.y != 0) {
        BiasPlace at = perspective_place(view, normal, position_la, z_m);
        at.distance_m = distance_m;
        bias = manual_bias(at);
        carried_m = max(plane_m - bias.along_normal_m, kNormalError_rad * distance_m);
    }
    ShadowPoint point;
    point.covered = z_m > 0.0 && view.numeric.z + view.axis_back.w / z_m >= 0.0;
    point.position = position_la + normal * bias.along_normal_m;
    float step_m = largest(point.position) * view.axis_u.w;
    point.step_u = axis_u * step_m;
    point.step_v = axis_v * step_m;
    point.bias_depth = bias.depth;
    point.plane_m = carried_m;
    point.spread_texel = spread;
    point.position_ca = off_proxies(view, position_ca, normal_ws);
    point.facts = facts_perspective(view, bias, length(position_la), z_m);
    vec3 in_face = point.position * face_axes(point.position);
    point.tangent = vec2(in_face.x, in_face.y) / largest(point.position);
    point.source_texel = source_texel;
    point.slope = vec2(0.0);
    point.reference = view.numeric.z + view.axis_back.w / largest(point.position) + bias.depth;
    if (kReadsMoments) point.covered = point.covered && is_drawn(point.position);
    point.reach_texel = reach_texel;
    return point;
}

ShadowPoint on_receiver_plane(ShadowPoint point, vec3 normal_ws) {
    vec3 normal = turned_back(normal_ws);
    float margin = receiver_plane_margin(shadow_slope(point, normal_ws));
    point.plane = -normal / point.plane_m;
    point.bias_depth += margin;
    point.facts.toward_m += margin * point.facts.depth_m;
    point.reference += margin;
    return point;
}

// Returns 0: each direction has one face, and nothing fades.
float shadow_fade_share(ShadowPoint first, float reach_texel) { return 0.0; }

bool shadow_fades_into(ShadowPoint second) { return false; }
