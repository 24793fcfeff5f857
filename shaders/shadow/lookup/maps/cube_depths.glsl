// Cubes, for filters that read depths.
#include "common/bindings.glsl"
layout(binding = kShadowMapUnit) uniform samplerCube shadow_map;

vec2 shadow_map_size() { return vec2(textureSize(shadow_map, 0)); }

float face_size() { return float(textureSize(shadow_map, 0).x); }

// Returns where the point lies in its face, texels; the middle of the first is at 1/2.
vec2 shadow_place(ShadowPoint point) { return (point.tangent * 0.5 + 0.5) * face_size(); }

vec3 direction_to(ShadowPoint point, vec2 place) {
    vec2 tangent = place / face_size() * 2.0 - 1.0;
    return face_axes(point.position) * vec3(tangent, -1.0);
}

// Returns the depth stored at a texel's middle. Beyond the face's edge it is what the neighbour stores in that
// direction, as depth of this face.
float shadow_depth(ShadowPoint point, vec2 middle) {
    vec3 direction = direction_to(point, middle);
    if (!is_drawn(direction)) return 0.0;
    float stored = textureLod(shadow_map, direction, 0.0).x, alpha = light.views[0].numeric.z;
    return stored > 0.0 ? alpha + (stored - alpha) * largest(direction) : 0.0;
}

// Returns whether all four texels around a corner are this face's.
bool is_inside(ShadowPoint point, vec2 corner) {
    return min(corner.x, corner.y) >= 1.0 && max(corner.x, corner.y) <= face_size() - 1.0 && is_drawn(point.position);
}
// Returns where one of the four lies from that corner, texels, in textureGather's order.
vec2 toward_gathered(int i) { return vec2(i == 1 || i == 2 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5); }

// Returns the depths of the four texels around a corner between texels, in that order. It is a loop for
// software devices: see shadow/filters/triangles/triangles.glsl.
vec4 shadow_depths(ShadowPoint point, vec2 corner) {
    vec4 four = vec4(0.0);
    bool gathers = is_inside(point, corner);
    if (gathers) four = textureGather(shadow_map, direction_to(point, corner));
    int i = 0;
    if (!gathers) do four[i] = shadow_depth(point, corner + toward_gathered(i));
    while (++i < 4);
    return four;
}
