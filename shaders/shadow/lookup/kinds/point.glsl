// Point light: a cube of up to six perspective views with common near and far. A face stores projected depth of
// its own axis, so the lookup needs only the largest coordinate, z.
#define SHADOW_CUBE 1
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/bias/automatic.glsl"
#ifdef SHADOW_MANUAL_BIAS
#include "shadow/lookup/bias/manual.glsl"
#endif
#ifdef SHADOW_SHOWN
#include "shadow/lookup/lookup_debug.glsl"
#endif
#include "shadow/lookup/tap_radius.glsl"
#include "shadow/lookup/light_size.glsl"
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS)
layout(binding = 4) uniform samplerCube shadow_map;
#else
layout(binding = 4) uniform samplerCubeShadow shadow_map;
#endif

#ifdef SHADOW_TRIANGLES
#include "shadow/filters/triangles/gathered_ids.glsl"
layout(binding = 5) uniform usamplerCube shadow_triangles;   // see shadow/filters/triangles/mesh_walk.glsl
#endif

struct ShadowPoint {
    bool covered;
    vec3 position;        // from the light, after the bias moved it
    vec3 step_u, step_v;  // one texel on the receiver's face, in metres at its distance
    float bias_depth;
    vec2 spread_texel;    // half-width of a disk of taps
    vec3 position_ca;     // what was asked for
#if defined(SHADOW_FOOTPRINT) || defined(SHADOW_TRIANGLES)
    vec3 normal;          // of the receiver
#endif
#ifdef SHADOW_TRIANGLES
    float error_m;        // how far position_ca may be off, along the view
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS)
    float reference;      // biased depth
#endif
#ifdef SHADOW_MOMENTS
    float reach_texel;    // what the bias is for
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_FOOTPRINT)
    vec2 source_texel;    // see shadow/lookup/light_size.glsl
    vec2 slope;           // of the receiver's plane: reversed depth per texel along u and v
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS)
    vec2 tangent;         // of its direction along the face's axes
#endif
#ifdef SHADOW_MANUAL_BIAS
    vec3 plane;           // the receiver's, where dot(plane, position) is 1, if taps are compared on it
#endif
#ifdef SHADOW_SHOWN
    LookupFacts facts;
#endif
};

// How far the light lies from the receiver's plane; more than rounding.
float light_from_plane_m(ShadowPoint point, vec3 normal) {
    return max(-dot(normal, point.position), kNormalError_rad * length(point.position));
}

#include "shadow/lookup/cube_faces.glsl"

// A face that was not drawn has no caster where it would be seen; it may hold anything.
bool is_drawn(vec3 direction) { return (light.options.w >> face_of(direction) & 1) != 0; }

// From the world's axes to the cube's.
vec3 turned_back(vec3 v) {
    vec3 axis = vec3(light.cone.x, light.cone.y, light.cone.z);
    return v + 2.0 * cross(axis, cross(axis, v) - light.cone.w * v);
}

#if defined(SHADOW_DEPTHS) || defined(SHADOW_MANUAL_BIAS) || defined(SHADOW_FOOTPRINT)
// 1 / z is linear in the tangents on any plane, see perspective_bias(); this one is the biased receiver's, but for
// plane_lift().
vec2 shadow_slope(ShadowPoint point, vec3 normal_ws) {
    vec3 normal = turned_back(normal_ws);
    ViewRecord view = light.views[0];
    vec3 n_map = normal * face_axes(point.position);
    float z_m = largest(point.position);
    float biased = view.axis_back.w + point.bias_depth * z_m;
    vec2 slope = vec2(n_map.x, n_map.y) * (-biased * view.axis_u.w / light_from_plane_m(point, normal));
    return slope * (1.0 - plane_lift(view, slope) * z_m / biased);
}
#endif

#ifdef SHADOW_DEPTHS
// How far from a point texels are read, where the bias is for those within reach_texel.
float read_texel(float reach_texel) { return max(reach_texel, SHADOW_REACH_TEXEL); }

// What the neighbour stores is half a texel of its own off the middle that is asked for.
float seam_texel(float reach_texel) { return max(reach_texel, 0.5); }

float face_size() { return float(textureSize(shadow_map, 0).x); }

// In texels of the face; the middle of the first is at 1/2.
vec2 shadow_place(ShadowPoint point) { return (point.tangent * 0.5 + 0.5) * face_size(); }

vec3 direction_to(ShadowPoint point, vec2 place) {
    vec2 tangent = place / face_size() * 2.0 - 1.0;
    return face_axes(point.position) * vec3(tangent, -1.0);
}

// Beyond the face's edge: what its neighbour stores in that direction, as depth of this one.
float shadow_depth(ShadowPoint point, vec2 middle) {
    vec3 direction = direction_to(point, middle);
    if (!is_drawn(direction)) return 0.0;
    float stored = textureLod(shadow_map, direction, 0.0).x, alpha = light.views[0].numeric.z;
    return stored > 0.0 ? alpha + (stored - alpha) * largest(direction) : 0.0;
}

// Whether all four texels around a corner are this face's.
bool is_inside(ShadowPoint point, vec2 corner) {
    return min(corner.x, corner.y) >= 1.0 && max(corner.x, corner.y) <= face_size() - 1.0 && is_drawn(point.position);
}
// Where they lie from there, in textureGather's order.
vec2 toward_gathered(int i) { return vec2(i == 1 || i == 2 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5); }

// Of the four texels around a corner between texels, in that order. A loop, because software devices run both sides of an if,
// all of it, but of a loop that is not needed one round.
vec4 shadow_depths(ShadowPoint point, vec2 corner) {
    vec4 four = vec4(0.0);
    bool gathers = is_inside(point, corner);
    if (gathers) four = textureGather(shadow_map, direction_to(point, corner));
    for (int i = gathers ? 4 : 0; i < 4; ++i) four[i] = shadow_depth(point, corner + toward_gathered(i));
    return four;
}

#ifdef SHADOW_TRIANGLES
// What these four show.
FourTriangles shadow_triangles_around(ShadowPoint point, vec2 corner) {
    FourTriangles shown;
    shown.instance = shown.triangle = uvec4(0u);
    vec3 direction = direction_to(point, corner);
    bool gathers = is_inside(point, corner);
    if (gathers) {
        shown.instance = textureGather(shadow_triangles, direction, 0);
        shown.triangle = textureGather(shadow_triangles, direction, 1);
    }
    for (int i = gathers ? 4 : 0; i < 4; ++i) {
        uvec4 one = textureLod(shadow_triangles, direction_to(point, corner + toward_gathered(i)), 0.0);
        shown.instance[i] = one.x;
        shown.triangle[i] = one.y;
    }
    return shown;
}

// Of a texel: tangents.
vec2 shadow_texel_sides(ShadowPoint point) { return vec2(light.views[0].axis_u.w, light.views[0].axis_v.w); }
#endif
#elif defined(SHADOW_MOMENTS)
#include "shadow/passes/prefilter/linear_distance.glsl"
float read_texel(float reach_texel) { return max(reach_texel, SHADOW_REACH_TEXEL); }
float seam_texel(float reach_texel) { return reach_texel; }

#ifdef SHADOW_FOOTPRINT
#include "shadow/passes/prefilter/pixel_footprint.glsl"
// From a step in the world to one in texels of the face.
vec2 step_in_face(ShadowPoint point, vec3 step_ws) {
    vec3 step_m = turned_back(step_ws) * face_axes(point.position);
    vec2 step_tan = (vec2(step_m.x, step_m.y) + point.tangent * step_m.z) / largest(point.position);
    return shortened(step_tan / light.views[0].axis_u.w);
}
#endif

// The sampler blends across seams; where the neighbour was not drawn it must not. texels: of the map, per one that is read.
vec2 kept_tangent(vec2 tangent, mat3 axes, float texels) {
    float inner = 1.0 - texels / float(textureSize(shadow_map, 0).x);
    for (int i = 0; i < 2; ++i) {
        vec3 across = vec3(0.0, 0.0, -1.0);
        across[i] = tangent[i] < 0.0 ? -1.01 : 1.01;
        if (abs(tangent[i]) > inner && !is_drawn(axes * across)) tangent[i] = clamp(tangent[i], -inner, inner);
    }
    return tangent;
}

#ifdef SHADOW_FOOTPRINT
// So many texels beside the point, of one level of its mipmaps or between two.
vec4 shadow_moments_at(ShadowPoint point, vec2 offset_texel, float level) {
    mat3 axes = face_axes(point.position);
    vec2 offset = offset_texel * (2.0 / float(textureSize(shadow_map, 0).x));
    vec2 tangent = kept_tangent(point.tangent + offset, axes, exp2(ceil(level)));
    return textureLod(shadow_map, axes * vec3(tangent, -1.0), level);
}

// For a lookup of texels within `reach` of it: before all of its plane there.
ShadowPoint before_plane(ShadowPoint point, float reach_texel) {
    point.reference += reach_texel * (abs(point.slope.x) + abs(point.slope.y));
    point.reach_texel = reach_texel;
    return point;
}
#endif

#ifdef SHADOW_FOOTPRINT
// Taps along the longer side of the pixel's footprint, as wide as its shorter one: a sampler would leave the face as it pleases
// and not know which faces were drawn. Most pixels need one.
vec4 shadow_moments(ShadowPoint point) {
    vec2 right = step_in_face(point, step_right(point.position_ca, point.normal));
    vec2 up = step_in_face(point, step_up(point.position_ca, point.normal));
    vec2 longer = length(right) > length(up) ? right : up;
    float longer_texel = length(longer), shorter_texel = max(min(length(right), length(up)), 1.0);
    int taps = int(clamp(ceil(longer_texel / shorter_texel), 1.0, light.moment_sampling.z));
    float most_level = float(textureQueryLevels(shadow_map) - 1);
    float level = min(log2(max(longer_texel / float(taps), 1.0)), most_level);
    vec4 sum = vec4(0.0);
    int i = 0;
    do {
        sum += shadow_moments_at(point, longer * ((float(i) + 0.5) / float(taps) - 0.5), level);
    } while (++i < taps);
    return sum / float(taps);
}
#else
vec4 shadow_moments(ShadowPoint point) {
    mat3 axes = face_axes(point.position);
    return textureLod(shadow_map, axes * vec3(kept_tangent(point.tangent, axes, 1.0), -1.0), 0.0);
}
#endif

// How much longer the way from the light is than its part along the face's axis; the least of that within reach.
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
#else
float read_texel(float reach_texel) { return reach_texel; }
float seam_texel(float reach_texel) { return reach_texel; }

// A tap that leaves the face is compared by the depth of the face it lands on.
float shadow_tap(ShadowPoint point, vec2 offset_texel) {
    vec3 direction = point.position + offset_texel.x * point.step_u + offset_texel.y * point.step_v;
    if (!is_drawn(direction)) return 1.0;
    ViewRecord view = light.views[0];
    float depth = view.numeric.z + view.axis_back.w / largest(direction);
#ifdef SHADOW_MANUAL_BIAS
    // Where the tap's direction meets the plane.
    if (compares_on_plane())
        depth = view.numeric.z + max(dot(point.plane, direction), 0.0) * view.axis_back.w / largest(direction);
#endif
    return texture(shadow_map, vec4(direction, clamp(depth + point.bias_depth, 0.0, 1.0)));
}
#endif

bool may_be_dark(ShadowPoint point) { return point.covered; }

#ifdef SHADOW_SHOWN
// The face that serves the point, in OpenGL's order; -1: none.
int shadow_layer(ShadowPoint point) {
    vec3 back = face_axes(point.position)[2];
    int face = int(dot(abs(back), vec3(0.0, 2.0, 4.0))) + (back.x + back.y + back.z > 0.0 ? 1 : 0);
    return point.covered && is_drawn(point.position) ? face : -1;
}
#endif

// Where the point lies in its face, in texels from a corner.
vec2 shadow_texel(ShadowPoint point) {
    float scale = 1.0 / largest(point.position);   // lest squares overflow
    vec3 position = point.position * scale, u = point.step_u * scale, v = point.step_v * scale;
    vec2 from_middle = vec2(dot(position, u) / dot(u, u), dot(position, v) / dot(v, v));
    return from_middle + 0.5 * vec2(textureSize(shadow_map, 0));
}

// Tangent of a texel's side: how much nearer to the light an offset along a direction brings a tap.
float shadow_texel_tan() { return light.views[0].axis_u.w; }

ShadowPoint shadow_point(int lookup, vec3 position_ca, vec3 normal_ws, float error_m, float reach_texel) {
    ViewRecord view = light.views[0];
    vec3 position_la = turned_back(position_ca + view.anchor_from_camera.xyz);
    vec3 normal = turned_back(normal_ws);
    mat3 map_axes = face_axes(position_la);
    vec3 axis_u = map_axes[0], axis_v = map_axes[1];
    float rounding_m = error_m + view.numeric.y + kPositionRounding * length(position_la);
    // Near a seam some taps land on the neighbour, whose axes see the plane's other tangents: take all three.
    vec3 n_map = normal * map_axes;
    float z_m = largest(position_la);
    float second = max(abs(dot(position_la, axis_u)), abs(dot(position_la, axis_v)));
    // Its texels are larger there, by the share that the tap lies beyond the seam.
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
#ifdef SHADOW_DEPTHS
    rounding_m += carried_error_m(vec2(view.axis_u.w * z_m), tangents, -dot(normal, normalize(position_la)));
#endif
    Bias bias = perspective_bias(view, n_map, tangents, leaving, position_la * map_axes, reach, rounding_m);
#ifdef SHADOW_MANUAL_BIAS
    if (light.options.y != 0) {
        BiasPlace at = perspective_place(view, normal, position_la, z_m);
        at.distance_m = length(position_la);
        bias = manual_bias(at);
    }
#endif
    ShadowPoint point;
    point.covered = z_m > 0.0 && view.numeric.z + view.axis_back.w / z_m >= 0.0;
    point.position = position_la + normal * bias.along_normal_m;
    float step_m = largest(point.position) * view.axis_u.w;
    point.step_u = axis_u * step_m;
    point.step_v = axis_v * step_m;
    point.bias_depth = bias.depth;
    point.spread_texel = spread;
    point.position_ca = position_ca;
#ifdef SHADOW_SHOWN
    point.facts = facts_perspective(view, bias, length(position_la), z_m);
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS)
    vec3 in_face = point.position * face_axes(point.position);
    point.tangent = vec2(in_face.x, in_face.y) / largest(point.position);
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_FOOTPRINT)
    point.source_texel = source_texel;
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS)
    point.reference = view.numeric.z + view.axis_back.w / largest(point.position) + bias.depth;
#endif
#ifdef SHADOW_MOMENTS
    point.covered = point.covered && is_drawn(point.position);
    point.reach_texel = reach_texel;
#endif
    return point;
}

#ifdef SHADOW_MANUAL_BIAS
ShadowPoint on_receiver_plane(ShadowPoint point, vec3 normal_ws) {
    vec3 normal = turned_back(normal_ws);
    float margin = receiver_plane_margin(shadow_slope(point, normal_ws));
    point.plane = -normal / light_from_plane_m(point, normal);
    point.bias_depth += margin;
#ifdef SHADOW_SHOWN
    point.facts.toward_m += margin * point.facts.depth_m;
#endif
#if defined(SHADOW_DEPTHS) || defined(SHADOW_MOMENTS)
    point.reference += margin;
#endif
    return point;
}
#endif
