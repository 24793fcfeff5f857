// Triangle that a pixel shows, as the surface pass writes it for lights by rays. What follows from it is computed where
// it is needed: of many fragments of small triangles only one stays.
#include "common/bindings.glsl"
#include "common/instances.glsl"
#include "lighting/gbuffer/triangle_normals.glsl"
layout(binding = kVertexUnit) uniform usamplerBuffer scene_vertices;   // two texels each, position first

struct SurfacePlace {
    float interpolated_m;        // along the view, by the rasteriser, metres
    uint corner;                 // a vertex of the triangle
    uint instance, triangle;
};

uvec4 packed_place(SurfacePlace place) {
    return uvec4(floatBitsToUint(place.interpolated_m), place.corner, place.instance, place.triangle);
}
SurfacePlace unpacked_place(uvec4 place) { return SurfacePlace(uintBitsToFloat(place.x), place.y, place.z, place.w); }

// Returns the receiver as rays name it: instance, triangle.
uvec2 receiver_of(SurfacePlace place) { return uvec2(place.instance, place.triangle); }

vec3 vertex_position(uint vertex) { return uintBitsToFloat(texelFetch(scene_vertices, 2 * int(vertex)).xyz); }

// Returns whether the distance to the triangle's plane is plausible beside the rasteriser's. It is not where the plane
// is seen edge-on, or where the triangle has no plane. Any distance within error_m has to be plausible: what is computed
// more exactly then is as well.
bool is_believed(float distance_m, float error_m, float interpolated_m) {
    const float kMostOff = 0.5;   // largest difference, as a share of the interpolated distance
    return abs(distance_m - interpolated_m) + error_m <= kMostOff * interpolated_m;
}
