// Point light: a cube of up to six perspective views with common near and far. A face stores projected depth of
// its own axis, so the lookup needs only the largest coordinate, z.
#include "shadow/light_block.glsl"
#include "shadow/bias.glsl"
#include "shadow/spread.glsl"
layout(binding = 4) uniform samplerCubeShadow shadow_map;

struct ShadowPoint {
    bool covered;
    vec3 position;        // from the light, after the bias moved it
    vec3 step_u, step_v;  // one texel on the receiver's face, in metres at its distance
    float bias_depth;
    vec2 spread_texel;    // half-width of a disk of taps
    vec3 position_ca;     // what was asked for
};

float largest(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// Faces in OpenGL's order. One that was not drawn has no caster where it would be seen; it may hold anything.
bool is_drawn(vec3 direction) {
    vec3 size = abs(direction);
    bool x_major = size.x >= size.y && size.x >= size.z;
    bool y_major = !x_major && size.y >= size.z;
    float along = x_major ? direction.x : (y_major ? direction.y : direction.z);
    int face = (x_major ? 0 : (y_major ? 2 : 4)) + (along < 0.0 ? 1 : 0);
    return (light.options.w >> face & 1) != 0;
}

// A tap that leaves the face is compared by the depth of the face it lands on.
float shadow_tap(ShadowPoint point, vec2 offset_texel) {
    vec3 direction = point.position + offset_texel.x * point.step_u + offset_texel.y * point.step_v;
    if (!is_drawn(direction)) return 1.0;
    ViewRecord view = light.views[0];
    float depth = view.numeric.z + view.axis_back.w / largest(direction);
    return texture(shadow_map, vec4(direction, clamp(depth + point.bias_depth, 0.0, 1.0)));
}

// Where the point lies in its face, in texels from a corner.
vec2 shadow_texel(ShadowPoint point) {
    float scale = 1.0 / largest(point.position);   // lest squares overflow
    vec3 position = point.position * scale, u = point.step_u * scale, v = point.step_v * scale;
    vec2 from_middle = vec2(dot(position, u) / dot(u, u), dot(position, v) / dot(v, v));
    return from_middle + 0.5 * vec2(textureSize(shadow_map, 0));
}

// Tangent of a texel's side: how much nearer to the light an offset along a direction brings a tap.
float shadow_texel_tan() { return light.views[0].axis_u.w; }

ShadowPoint shadow_point(vec3 position_ca, vec3 normal, float error_m, float reach_texel) {
    ViewRecord view = light.views[0];
    vec3 position_la = position_ca + view.anchor_from_camera.xyz;
    vec3 size = abs(position_la);
    bool x_major = size.x >= size.y && size.x >= size.z;
    bool y_major = !x_major && size.y >= size.z;
    vec3 axis_u = x_major ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 axis_v = x_major || y_major ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0);
    vec3 axis_back = x_major ? vec3(-sign(position_la.x), 0.0, 0.0)
                             : (y_major ? vec3(0.0, -sign(position_la.y), 0.0) : vec3(0.0, 0.0, -sign(position_la.z)));
    mat3 map_axes = mat3(axis_u, axis_v, axis_back);
    float rounding_m = error_m + view.numeric.y * length(position_la);
    // Near a seam some taps land on the neighbour, whose axes see the plane's other tangents: take all three.
    vec3 n_map = normal * map_axes;
    float z_m = largest(position_la);
    float second = max(abs(dot(position_la, axis_u)), abs(dot(position_la, axis_v)));
    // Its texels are larger there, by the share that the tap lies beyond the seam.
    vec2 tangents = abs(n_map.xy);
    vec2 spread = shadow_spread(vec2(view.axis_u.w, view.axis_v.w) * z_m, length(position_ca));
    float reach = reach_texel + max(spread.x, spread.y);
    float beyond = (reach + 1.0) * view.axis_u.w;
    if (second > z_m * (1.0 - 2.0 * beyond)) tangents = (tangents + abs(n_map.z)) * (1.0 + beyond);
    Bias bias = perspective_bias(view, n_map, tangents, position_la * map_axes, reach, rounding_m);
    if (light.options.y != 0) bias = Bias(0.0, view.axis_back.w * light.bias.x / (z_m * z_m));
    ShadowPoint point;
    point.covered = z_m > 0.0 && view.numeric.z + view.axis_back.w / z_m >= 0.0;
    point.position = position_la + normal * bias.along_normal_m;
    float step_m = largest(point.position) * view.axis_u.w;
    point.step_u = axis_u * step_m;
    point.step_v = axis_v * step_m;
    point.bias_depth = bias.depth;
    point.spread_texel = spread;
    point.position_ca = position_ca;
    return point;
}
