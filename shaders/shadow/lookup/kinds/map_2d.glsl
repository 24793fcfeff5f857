// What the kinds with flat maps share: one compare tap, `offset_texel` texels away from the receiver; or, for filters
// that read depths (SHADOW_DEPTHS), what is stored and how the receiver's plane lies in the map; or what is stored of a
// prefiltered map (SHADOW_MOMENTS).
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS)
layout(binding = 4) uniform sampler2DArray shadow_map;
#else
layout(binding = 4) uniform sampler2DArrayShadow shadow_map;
#endif

#ifdef SHADOW_TRIANGLES
#include "shadow/filters/triangles/gathered_ids.glsl"
layout(binding = 5) uniform usampler2DArray shadow_triangles;   // see shadow/filters/triangles/mesh_walk.glsl
#endif

struct ShadowPoint {
    bool covered;       // false: no map holds this point, it is lit
    vec3 map;           // u, v, biased reference depth
    float layer;
    vec2 texel_uv;
    vec2 spread_texel;  // half-width of a disk of taps
    vec3 position_ca;   // what was asked for
#if defined(SHADOW_FOOTPRINT) || defined(SHADOW_TRIANGLES)
    vec3 normal;        // of the receiver
#endif
    float reads_texel;  // how far from it texels are read
#ifdef SHADOW_SHOWN
    LookupFacts facts;
#endif
#ifdef SHADOW_TRIANGLES
    float error_m;      // how far position_ca may be off, along the view
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS)
    float reference;    // map.z
    vec2 source_texel;  // see shadow/lookup/light_size.glsl
    vec2 tangent;       // of its direction in a perspective view; 0: of a sun
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS) || defined(SHADOW_MANUAL_BIAS)
    int view;
    vec2 slope;         // of the receiver's plane: reversed depth per texel along u and v; 0 if taps are not compared on it
#endif
};

vec3 row_xyz(mat4 m, int row) { return vec3(m[0][row], m[1][row], m[2][row]); }

#if defined(SHADOW_DEPTHS) || defined(SHADOW_MANUAL_BIAS) || defined(SHADOW_FOOTPRINT)
// A plane stays one under any projection: its slope follows from how u, v and depth change along two of its directions.
// It is the biased receiver's plane, but for plane_lift().
vec2 shadow_slope(ShadowPoint point, vec3 normal) {
    mat4 map_from_anchor = light.views[point.view].map_from_anchor;
    vec3 along_w = row_xyz(map_from_anchor, 3);
    vec3 along_u = row_xyz(map_from_anchor, 0) - point.map.x * along_w;
    vec3 along_v = row_xyz(map_from_anchor, 1) - point.map.y * along_w;
    vec3 along_depth = row_xyz(map_from_anchor, 2) - point.map.z * along_w;
    vec3 ray = cross(along_u, along_v);
    float facing = dot(ray, normal);
    float least = kNormalError_rad * length(ray);
    if (abs(facing) < least) facing = facing < 0.0 ? -least : least;
    vec3 over_u = cross(along_v, normal) * (point.texel_uv.x / facing), over_v = cross(normal, along_u) * (point.texel_uv.y / facing);
    vec2 slope = vec2(dot(over_u, along_depth), dot(over_v, along_depth));
    return slope + plane_lift(light.views[point.view], slope) * vec2(dot(over_u, along_w), dot(over_v, along_w));
}
#endif

#ifdef SHADOW_DEPTHS
// How far from a point texels are read, where the bias is for those within reach_texel.
float read_texel(float reach_texel) { return max(reach_texel, SHADOW_REACH_TEXEL); }

// In texels; the middle of the first is at 1/2.
vec2 shadow_place(ShadowPoint point) { return point.map.xy / point.texel_uv; }

float shadow_depth(ShadowPoint point, vec2 middle) {
    return textureLod(shadow_map, vec3(middle * point.texel_uv, point.layer), 0.0).x;
}

// Of the four texels around a corner between texels, in textureGather's order.
vec4 shadow_depths(ShadowPoint point, vec2 corner) {
    return textureGather(shadow_map, vec3(corner * point.texel_uv, point.layer));
}

#ifdef SHADOW_TRIANGLES
// What these four show.
FourTriangles shadow_triangles_around(ShadowPoint point, vec2 corner) {
    vec3 at = vec3(corner * point.texel_uv, point.layer);
    FourTriangles shown;
    shown.instance = textureGather(shadow_triangles, at, 0);
    shown.triangle = textureGather(shadow_triangles, at, 1);
    return shown;
}

// Of a texel: metres, or tangents from a lamp.
vec2 shadow_texel_sides(ShadowPoint point) { return vec2(light.views[point.view].axis_u.w, light.views[point.view].axis_v.w); }
#endif
#elif defined(SHADOW_MOMENTS)
float read_texel(float reach_texel) { return max(reach_texel, SHADOW_REACH_TEXEL); }

#ifdef SHADOW_FOOTPRINT
#include "shadow/passes/prefilter/pixel_footprint.glsl"
vec2 in_texels(ShadowPoint point, vec3 step_m) {
    ViewRecord view = light.views[point.view];
    vec3 along_w = row_xyz(view.map_from_anchor, 3);
    vec3 along_u = row_xyz(view.map_from_anchor, 0) - point.map.x * along_w;
    vec3 along_v = row_xyz(view.map_from_anchor, 1) - point.map.y * along_w;
    float w = dot(along_w, point.position_ca + view.anchor_from_camera.xyz) + view.map_from_anchor[3][3];
    return shortened(vec2(dot(along_u, step_m), dot(along_v, step_m)) / (w * point.texel_uv));
}

// So many texels beside the point, of one level of its mipmaps or between two.
vec4 shadow_moments_at(ShadowPoint point, vec2 offset_texel, float level) {
    return textureLod(shadow_map, vec3(point.map.xy + offset_texel * point.texel_uv, point.layer), level);
}

// For a lookup of texels within `reach` of it: before all of its plane there.
ShadowPoint before_plane(ShadowPoint point, float reach_texel) {
    point.reference = clamp(point.reference + reach_texel * (abs(point.slope.x) + abs(point.slope.y)), 0.0, 1.0);
    return point;
}

vec4 shadow_moments(ShadowPoint point) {
    return textureGrad(shadow_map, vec3(point.map.xy, point.layer), in_texels(point, step_right(point.position_ca, point.normal)) * point.texel_uv,
                       in_texels(point, step_up(point.position_ca, point.normal)) * point.texel_uv);
}
#else
vec4 shadow_moments(ShadowPoint point) { return textureLod(shadow_map, vec3(point.map.xy, point.layer), 0.0); }
#endif
#else
float read_texel(float reach_texel) { return reach_texel; }

float shadow_tap(ShadowPoint point, vec2 offset_texel) {
    float reference = point.map.z;
#ifdef SHADOW_MANUAL_BIAS
    reference = clamp(reference + dot(point.slope, offset_texel), 0.0, 1.0);
#endif
    return texture(shadow_map, vec4(point.map.xy + offset_texel * point.texel_uv, point.layer, reference));
}
#endif

// Whether it has to be looked up; else it is lit.
bool may_be_dark(ShadowPoint point) { return point.covered && point.layer >= 0.0; }

#ifdef SHADOW_SHOWN
// Which of the light's maps serves the point; -1: none.
int shadow_layer(ShadowPoint point) { return point.covered ? int(point.layer) : -1; }
#endif

// Where the point lies in the map, in texels from its corner.
vec2 shadow_texel(ShadowPoint point) { return point.map.xy / point.texel_uv; }

// Tangent of a texel's side where directions count (a cube); a flat map does not tell what lies toward the light.
float shadow_texel_tan() { return 0.0; }

// Beyond the far plane depth is negative: not covered. Before the near plane it is clamped onto it.
// Nearer than `margin_texel` to the border a filter would read past it: not covered.
ShadowPoint point_2d(int view, vec4 projected, float bias_depth, float margin_texel) {
    ShadowPoint point;
    point.texel_uv = 1.0 / vec2(textureSize(shadow_map, 0).xy);
    vec3 map = projected.xyz / projected.w;
    vec2 margin = margin_texel * point.texel_uv;
    point.covered = projected.w > 0.0 && map.z >= 0.0 && all(greaterThanEqual(map.xy, margin)) && all(lessThanEqual(map.xy, 1.0 - margin));
    point.map = vec3(map.xy, clamp(map.z + bias_depth, 0.0, 1.0));
    point.layer = light.views[view].numeric.w;
    point.reads_texel = margin_texel;
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS)
    point.reference = point.map.z;
    point.source_texel = point.tangent = vec2(0.0);
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS) || defined(SHADOW_MANUAL_BIAS)
    point.view = view;
    point.slope = vec2(0.0);
#endif
    return point;
}

#ifdef SHADOW_MANUAL_BIAS
ShadowPoint on_receiver_plane(ShadowPoint point, vec3 normal) {
    point.slope = shadow_slope(point, normal);
    float margin = receiver_plane_margin(point.slope);
    point.map.z = clamp(point.map.z + margin, 0.0, 1.0);
#ifdef SHADOW_SHOWN
    point.facts.toward_m += margin * point.facts.depth_m;
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS)
    point.reference = point.map.z;
#endif
    return point;
}
#endif
