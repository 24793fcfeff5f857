// Flat maps, for filters that read depths and the triangles that texels show.
#include "common/bindings.glsl"
#include "shadow/lookup/maps/flat_depths.glsl"
#include "shadow/filters/triangles/gathered_ids.glsl"
layout(binding = kShownTriangleUnit) uniform usampler2DArray shadow_triangles;   // see shadow/filters/triangles/mesh_walk.glsl

// Returns what the four texels around a corner show.
FourTriangles shadow_triangles_around(ShadowPoint point, vec2 corner) {
    vec3 at = vec3(corner * point.texel_uv, point.layer);
    FourTriangles shown;
    shown.instance = textureGather(shadow_triangles, at, 0);
    shown.triangle = textureGather(shadow_triangles, at, 1);
    return shown;
}

// Returns the sides of a texel: metres, or tangents from a lamp.
vec2 shadow_texel_sides(ShadowPoint point) { return vec2(light.views[point.view].axis_u.w, light.views[point.view].axis_v.w); }
