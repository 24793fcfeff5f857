// Two normals of a fragment. The geometric one comes from the triangle's own plane, computed once on the CPU in double.
// Screen-space derivatives would be noisy on large triangles, and the bias rests on it.
#include "common/bindings.glsl"
#include "common/view_vector.glsl"
#include "common/unit.glsl"
layout(binding = kTriangleNormalUnit) uniform usamplerBuffer normal_texels;   // per triangle

vec4 triangle_normal(uint triangle) { return uintBitsToFloat(texelFetch(normal_texels, int(triangle))); }

vec3 geometric_normal(InstanceRecord instance, uint triangle, vec3 position_ca) {
    vec3 n = unit_or(normal_from_model(instance, triangle_normal(triangle).xyz), camera.back.xyz);
    return dot(n, to_camera(position_ca)) < 0.0 ? -n : n;
}

vec3 shading_normal(vec3 interpolated, vec3 geometric) {
    float size = length(interpolated);
    const float kMost = 3e38;   // finite
    vec3 n = size > 0.0 && size < kMost ? interpolated / size : unit_or(interpolated, geometric);
    return dot(n, geometric) < 0.0 ? -n : n;
}
