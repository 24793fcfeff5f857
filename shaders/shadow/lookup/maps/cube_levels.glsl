// Prefiltered cubes: reading one level of their mipmaps, or between two.
#include "common/bindings.glsl"
layout(binding = kShadowMapUnit) uniform samplerCube shadow_map;

// The sampler blends across seams; where the neighbour was not drawn it must not. texels: of the map, per one that is read.
vec2 kept_tangent(vec2 tangent, mat3 axes, float texels) {
    float inner = 1.0 - texels / float(textureSize(shadow_map, 0).x);
    for (int i = 0; i < 2; ++i) {
        vec3 across = vec3(0.0, 0.0, -1.0);
        across[i] = tangent[i] < 0.0 ? -1.01 : 1.01;
        if (abs(tangent[i]) > inner && !is_drawn(axes * across)) tangent[i] = clamp(tangent[i], -inner, inner);
    }
    return tangent;
}

// So many texels beside the point, of one level of its mipmaps or between two.
vec4 shadow_moments_at(ShadowPoint point, vec2 offset_texel, float level) {
    mat3 axes = face_axes(point.position);
    vec2 offset = offset_texel * (2.0 / float(textureSize(shadow_map, 0).x));
    vec2 tangent = kept_tangent(point.tangent + offset, axes, exp2(ceil(level)));
    return textureLod(shadow_map, axes * vec3(tangent, -1.0), level);
}

// For a lookup of texels within `reach` of it: before all of its plane there.
ShadowPoint before_plane(ShadowPoint point, float reach_texel) {
    point.reference += reach_texel * (abs(point.slope.x) + abs(point.slope.y));
    point.reach_texel = reach_texel;
    return point;
}
