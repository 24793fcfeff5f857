// Cubes, for filters that read depths and the triangles that texels show.
#include "common/bindings.glsl"
#include "shadow/lookup/maps/cube_depths.glsl"
#include "shadow/filters/triangles/gathered_ids.glsl"
layout(binding = kShownTriangleUnit) uniform usamplerCube shadow_triangles;   // see shadow/filters/triangles/mesh_walk.glsl

// Returns what the four texels around a corner show.
FourTriangles shadow_triangles_around(ShadowPoint point, vec2 corner) {
    FourTriangles shown;
    shown.instance = shown.triangle = uvec4(0u);
    vec3 direction = direction_to(point, corner);
    bool gathers = is_inside(point, corner);
    if (gathers) {
        shown.instance = textureGather(shadow_triangles, direction, 0);
        shown.triangle = textureGather(shadow_triangles, direction, 1);
    }
    int i = 0;
    if (!gathers) do {
        uvec4 one = textureLod(shadow_triangles, direction_to(point, corner + toward_gathered(i)), 0.0);
        shown.instance[i] = one.x;
        shown.triangle[i] = one.y;
    } while (++i < 4);
    return shown;
}

// Returns the sides of a texel, tangents.
vec2 shadow_texel_sides(ShadowPoint point) { return vec2(light.views[0].axis_u.w, light.views[0].axis_v.w); }
