// Prefiltered cubes without mipmaps.
#include "shadow/lookup/maps/cube_levels.glsl"

vec4 shadow_moments(ShadowPoint point) {
    mat3 axes = face_axes(point.position);
    return textureLod(shadow_map, axes * vec3(kept_tangent(point.tangent, axes, 1.0), -1.0), 0.0);
}
