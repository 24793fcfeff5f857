// Surfaces of another renderer's picture as light passes read them, from its depth buffer and, where it has them, its
// normals (HAS_NORMALS). MULTISAMPLED: both have samples; one of them is read.
#include "common/bindings.glsl"
#include "common/octahedral.glsl"
#include "common/pixel_ray.glsl"
#include "common/unit.glsl"
#include "common/view_vector.glsl"
#if MULTISAMPLED
layout(binding = kImportedDepthUnit) uniform sampler2DMS imported_depth;
layout(binding = kImportedNormalUnit) uniform sampler2DMS imported_normals;
#else
layout(binding = kImportedDepthUnit) uniform sampler2D imported_depth;
layout(binding = kImportedNormalUnit) uniform sampler2D imported_normals;
#endif
// C++ twin: ImportRecord in systems/lighting/mask_pass.h.
layout(std140, binding = kImportBlock) uniform ImportBlock {
    vec4 depth;      // x, y: see imported_distance(); z: depth where there is no surface
    ivec4 normals;   // x: 1: components of [-1, 1]; 2: of [0, 1]. y: 1: along the camera's axes, 0: the world's. z: sample
} imported;
layout(location = 0) out vec4 normals_out;

// Returns the distance along the view of a depth, metres.
float imported_distance(float depth) {
    return camera.back.w > 0.5 ? imported.depth.x * depth + imported.depth.y : imported.depth.x / (depth + imported.depth.y);
}

// Returns the reversed depth of a distance: the inverse of view_distance().
float reversed_depth(float distance_m) {
    return camera.back.w > 0.5 ? (camera.unproject.x - distance_m) / camera.unproject.y
                               : camera.unproject.y / distance_m - camera.unproject.x;
}

// Returns what texelFetch() takes beside the pixel: the sample, or the level.
#if MULTISAMPLED
ivec2 picture_size() { return textureSize(imported_depth); }
int fetched() { return imported.normals.z; }
#else
ivec2 picture_size() { return textureSize(imported_depth, 0); }
int fetched() { return 0; }
#endif

float depth_at(ivec2 pixel) {
    return texelFetch(imported_depth, clamp(pixel, ivec2(0), picture_size() - 1), fetched()).r;
}

#if HAS_NORMALS
vec3 normal_at(ivec2 pixel, float depth) {
    vec3 normal = texelFetch(imported_normals, pixel, fetched()).xyz;
    if (imported.normals.x == 2) normal = 2.0 * normal - 1.0;
    if (imported.normals.y == 0) return normal;
    return camera.right.xyz * normal.x + camera.up.xyz * normal.y + camera.back.xyz * normal.z;
}
#else
vec3 position_at(ivec2 pixel, float depth) { return position_seen_at(pixel, imported_distance(depth)); }

// Returns the difference of positions along one axis of the picture. Depth is linear over the pixels of a plane: the
// side where it goes on so is taken, since the other may show another surface.
vec3 tangent(ivec2 pixel, float depth, ivec2 step) {
    float before = depth_at(pixel - step), after = depth_at(pixel + step);
    float bend_before = abs(2.0 * before - depth_at(pixel - 2 * step) - depth);
    ivec2 last = ivec2(camera.unproject.zw) - 1;
    float bend_after = abs(2.0 * after - depth_at(min(pixel + 2 * step, last)) - depth);
    // Beyond the picture's edge no depth was drawn.
    const float kNoPlane = 3.0e38;
    if (any(lessThan(pixel, step))) bend_before = kNoPlane;
    if (any(greaterThan(pixel + step, last))) bend_after = kNoPlane;
    vec3 here = position_at(pixel, depth);
    return bend_before < bend_after ? here - position_at(pixel - step, before) : position_at(pixel + step, after) - here;
}

vec3 normal_at(ivec2 pixel, float depth) {
    return cross(tangent(pixel, depth, ivec2(1, 0)), tangent(pixel, depth, ivec2(0, 1)));
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = depth_at(pixel);
    if (depth == imported.depth.z) discard;
    float distance_m = imported_distance(depth);
    vec3 to_viewer = unit_or(to_camera(position_seen_at(pixel, distance_m)), camera.back.xyz);
    vec3 normal = unit_or(normal_at(pixel, depth), to_viewer);
    vec2 packed_normal = octahedral_from_unit(dot(normal, to_viewer) < 0.0 ? -normal : normal);
    normals_out = vec4(packed_normal, packed_normal);
    gl_FragDepth = reversed_depth(distance_m);
}
