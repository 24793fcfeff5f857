// Flat maps, for filters that read depths and the triangles that texels show.
#include "common/bindings.glsl"
#include "shadow/lookup/maps/flat_depths.glsl"
#include "shadow/filters/triangles/gathered_ids.glsl"
layout(binding = kShownTriangleUnit) uniform usampler2DArray shadow_triangles;   // see shadow/filters/triangles/mesh_walk.glsl

// Returns what the four texels around a corner show.
FourTriangles shadow_triangles_around(ShadowPoint point, vec2 corner) {
    vec3 at = vec3(corner * point.texel_uv, point.layer);
    int bits = int(light.moment_sampling.w);
    uvec4 second = uvec4(0u);
    if (bits == 0) second = textureGather(shadow_triangles, at, 1);
    return unpacked_triangles(textureGather(shadow_triangles, at, 0), second, bits);
}

// Returns the instance and the triangle that a texel shows.
uvec2 shadow_triangle_at(ShadowPoint point, vec2 middle) {
    uvec4 shown = textureLod(shadow_triangles, vec3(middle * point.texel_uv, point.layer), 0.0);
    return unpacked_triangle(shown.xy, int(light.moment_sampling.w));
}

// Returns the sides of a texel: metres, or tangents from a lamp.
vec2 shadow_texel_sides(ShadowPoint point) { return vec2(light.views[point.view].axis_u.w, light.views[point.view].axis_v.w); }
