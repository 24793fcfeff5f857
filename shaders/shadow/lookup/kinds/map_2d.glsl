// Lookup in a flat map, for all kinds that have one: where a point lies in it. SHADOW_FLAT_MAP names the file that
// reads the map.
#include "shadow/lookup/row_flags.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/bias/automatic.glsl"
#include "shadow/lookup/bias/manual.glsl"
#include "shadow/lookup/lookup_debug.glsl"
#include "shadow/lookup/tap_radius.glsl"
#include "shadow/lookup/light_size.glsl"
#include "shadow/passes/prefilter/linear_distance.glsl"

struct ShadowPoint {
    bool covered;       // false: no map holds this point, it is lit
    int view;
    vec3 map;           // u, v, biased reference depth
    float layer;
    float reference;    // map.z
    vec2 slope;         // slope of the receiver's plane: reversed depth per texel along u and v; 0 if taps are not
                        // compared on it
    vec3 carried_aa;    // point of the plane that is carried to other texels, from the view's anchor, metres
    vec2 texel_uv;
    vec2 spread_texel;  // half-width of a disk of taps
    vec2 source_texel;  // see shadow/lookup/light_size.glsl
    vec2 tangent;       // tangent of its direction in a perspective view; 0: a sun's map
    float reads_texel;  // how far from it texels are read
    vec3 position_ca;   // from the camera's anchor, as it was given
    float error_m;      // how far position_ca may be off, metres
    vec3 normal;        // the receiver's
    LookupFacts facts;
};

vec3 row_xyz(mat4 m, int row) { return vec3(m[0][row], m[1][row], m[2][row]); }

#include SHADOW_FLAT_MAP

// Returns the slope of the plane that is carried to other texels: reversed depth per texel along u and v. A plane stays
// one under any projection: its slope follows from how u, v and depth change along two of its directions.
vec2 shadow_slope(ShadowPoint point, vec3 normal) {
    mat4 map_from_anchor = light.views[point.view].map_from_anchor;
    vec4 projected = map_from_anchor * vec4(point.carried_aa, 1.0);
    vec3 map = projected.xyz / projected.w;
    vec3 along_w = row_xyz(map_from_anchor, 3);
    vec3 along_u = row_xyz(map_from_anchor, 0) - map.x * along_w;
    vec3 along_v = row_xyz(map_from_anchor, 1) - map.y * along_w;
    vec3 along_depth = row_xyz(map_from_anchor, 2) - map.z * along_w;
    vec3 ray = cross(along_u, along_v);
    float facing = dot(ray, normal);
    float least = kNormalError_rad * length(ray);
    if (abs(facing) < least) facing = facing < 0.0 ? -least : least;
    vec3 over_u = cross(along_v, normal) * (point.texel_uv.x / facing), over_v = cross(normal, along_u) * (point.texel_uv.y / facing);
    return vec2(dot(over_u, along_depth), dot(over_v, along_depth));
}

// Returns whether the point has to be looked up. If not, it is lit.
bool may_be_dark(ShadowPoint point) { return point.covered && point.layer >= 0.0; }

// Returns the layer of the map that serves the point; -1: none.
int shadow_layer(ShadowPoint point) { return point.covered ? int(point.layer) : -1; }

// Returns where the point lies in the map, texels from its corner.
vec2 shadow_texel(ShadowPoint point) { return point.map.xy / point.texel_uv; }

// Returns how far the point's place in the map moves, texels, as the receiver moves by a small step, metres.
vec2 texels_moved(ShadowPoint point, vec3 step_m) {
    ViewRecord view = light.views[point.view];
    vec2 across = vec2(dot(view.axis_u.xyz, step_m), dot(view.axis_v.xyz, step_m));
    return (across + point.tangent * dot(view.axis_back.xyz, step_m)) / point.facts.texel_m;
}

// Returns the tangent of a texel's side, which disks around a point in a cube need. 0: this is a flat map.
float shadow_texel_tan() { return 0.0; }

// Returns the point's place in a map. Beyond the far plane depth is negative: not covered. Before the near plane it is
// clamped onto it. Nearer than `margin_texel` to the border a filter would read past it: not covered.
ShadowPoint point_2d(int view, vec4 projected, float bias_depth, float margin_texel) {
    ShadowPoint point;
    point.view = view;
    point.texel_uv = 1.0 / shadow_map_size();
    vec3 map = projected.xyz / projected.w;
    vec2 margin = margin_texel * point.texel_uv;
    point.covered = projected.w > 0.0 && map.z >= 0.0 && all(greaterThanEqual(map.xy, margin)) && all(lessThanEqual(map.xy, 1.0 - margin));
    point.map = vec3(map.xy, clamp(map.z + bias_depth, 0.0, 1.0));
    point.reference = point.map.z;
    point.layer = light.views[view].numeric.w;
    point.reads_texel = margin_texel;
    point.slope = point.source_texel = point.tangent = vec2(0.0);
    return point;
}

ShadowPoint on_receiver_plane(ShadowPoint point, vec3 normal) {
    point.slope = shadow_slope(point, normal);
    float margin = receiver_plane_margin(point.slope);
    point.map.z = clamp(point.map.z + margin, 0.0, 1.0);
    point.facts.toward_m += margin * point.facts.depth_m;
    point.reference = point.map.z;
    return point;
}
