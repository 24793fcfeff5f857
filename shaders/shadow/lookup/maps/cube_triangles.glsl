// Cubes, for filters that read depths and the triangles that texels show.
#include "common/bindings.glsl"
#include "shadow/lookup/maps/cube_depths.glsl"
#include "shadow/filters/triangles/gathered_ids.glsl"
layout(binding = kShownTriangleUnit) uniform usamplerCube shadow_triangles;   // see shadow/filters/triangles/mesh_walk.glsl

// Returns what the four texels around a corner show.
FourTriangles shadow_triangles_around(ShadowPoint point, vec2 corner) {
    uvec4 first = uvec4(0u), second = uvec4(0u);
    int bits = int(light.moment_sampling.w);
    vec3 direction = direction_to(point, corner);
    bool gathers = is_inside(point, corner);
    if (gathers) {
        first = textureGather(shadow_triangles, direction, 0);
        if (bits == 0) second = textureGather(shadow_triangles, direction, 1);
    }
    int i = 0;
    if (!gathers) do {
        uvec4 one = textureLod(shadow_triangles, direction_to(point, corner + toward_gathered(i)), 0.0);
        first[i] = one.x;
        second[i] = one.y;
    } while (++i < 4);
    return unpacked_triangles(first, second, bits);
}

// Returns the instance and the triangle that a texel shows; beyond the face's edge what the neighbour stores there.
uvec2 shadow_triangle_at(ShadowPoint point, vec2 middle) {
    uvec4 shown = textureLod(shadow_triangles, direction_to(point, middle), 0.0);
    return unpacked_triangle(shown.xy, int(light.moment_sampling.w));
}

// Returns the sides of a texel, tangents.
vec2 shadow_texel_sides(ShadowPoint point) { return vec2(light.views[0].axis_u.w, light.views[0].axis_v.w); }
