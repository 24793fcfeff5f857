// Prefiltered cubes: reading one level of their mipmaps, or between two.
#include "common/bindings.glsl"
layout(binding = kShadowMapUnit) uniform samplerCube shadow_map;

vec2 shadow_map_size() { return vec2(textureSize(shadow_map, 0)); }

// Keeps a lookup from blending across a seam where the neighbour was not drawn. texels: of the map, per texel of the
// level that is read.
vec2 kept_tangent(vec2 tangent, mat3 axes, float texels) {
    float inner = 1.0 - texels / float(textureSize(shadow_map, 0).x);
    for (int i = 0; i < 2; ++i) {
        vec3 across = vec3(0.0, 0.0, -1.0);
        across[i] = tangent[i] < 0.0 ? -1.01 : 1.01;
        if (abs(tangent[i]) > inner && !is_drawn(axes * across)) tangent[i] = clamp(tangent[i], -inner, inner);
    }
    return tangent;
}

// Returns the moments some texels beside the point, of one level of the mipmaps or between two.
vec4 shadow_moments_at(ShadowPoint point, vec2 offset_texel, float level) {
    mat3 axes = face_axes(point.position);
    vec2 offset = offset_texel * (2.0 / float(textureSize(shadow_map, 0).x));
    vec2 tangent = kept_tangent(point.tangent + offset, axes, exp2(ceil(level)));
    return textureLod(shadow_map, axes * vec3(tangent, -1.0), level);
}

// Moves the reference before all of the receiver's plane within `reach_texel`, for a lookup of texels that far.
ShadowPoint before_plane(ShadowPoint point, float reach_texel) {
    point.reference += reach_texel * (abs(point.slope.x) + abs(point.slope.y));
    point.reach_texel = reach_texel;
    return point;
}
