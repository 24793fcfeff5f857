// Cubes, for filters that read depths.
#include "common/bindings.glsl"
layout(binding = kShadowMapUnit) uniform samplerCube shadow_map;

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
