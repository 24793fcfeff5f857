// Test of a masked material at a point of a triangle: does its mask leave the surface there? It reads the texture's
// finest level, as the depth passes do. Float twin of engine/rays/alpha_mask.cpp. One buffer contains the alpha of all
// textures, a byte per texel. C++ twin: RayMask in systems/extract/ray_masks.h.
#include "common/bindings.glsl"
layout(std430, binding = kMaskBuffer) readonly buffer RayMaskBuffer { uint ray_masks[]; };

const bool kHasMasks = true;
const uint kNoMaskTexture = 0xffffffffu;
const uint kWrapRepeat = 0u, kWrapMirror = 1u;   // else clamped; assets::TextureWrap

struct RayMask {
    float cutoff, alpha;
    uint texels;             // word of the first, four to a word; kNoMaskTexture: alpha alone decides
    uint width, height;
    uint wrap_u, wrap_v;
    bool linear;
    bool coloured;           // triangles have the alpha of their corners behind their coordinates
    float chord_texel;       // how wide what it leaves is, on average, texels
};

RayMask ray_mask(uint at) {
    return RayMask(uintBitsToFloat(ray_masks[at]), uintBitsToFloat(ray_masks[at + 1u]), ray_masks[at + 2u],
                   ray_masks[at + 3u], ray_masks[at + 4u], ray_masks[at + 5u], ray_masks[at + 6u], (ray_masks[at + 7u] & 1u) != 0u, (ray_masks[at + 7u] & 2u) != 0u,
                   uintBitsToFloat(ray_masks[at + 8u]));
}

vec2 mask_uv(uint at) { return vec2(uintBitsToFloat(ray_masks[at]), uintBitsToFloat(ray_masks[at + 1u])); }

float corner_alpha(uint uvs, uint corner) { return uintBitsToFloat(ray_masks[uvs + 6u + corner]); }

// Returns a texel's number within the texture. `texel`: a whole number.
uint wrapped_texel(float texel, uint size, uint wrap) {
    float edge = float(size);
    if (wrap == kWrapRepeat) return uint(clamp(texel - edge * floor(texel / edge), 0.0, edge - 1.0));
    if (wrap == kWrapMirror) {
        float there_and_back = clamp(texel - 2.0 * edge * floor(texel / (2.0 * edge)), 0.0, 2.0 * edge - 1.0);
        return uint(there_and_back < edge ? there_and_back : 2.0 * edge - 1.0 - there_and_back);
    }
    return uint(clamp(texel, 0.0, edge - 1.0));
}

float mask_alpha(RayMask mask, vec2 texel) {
    uint x = wrapped_texel(texel.x, mask.width, mask.wrap_u), y = wrapped_texel(texel.y, mask.height, mask.wrap_v);
    uint i = y * mask.width + x;
    return float((ray_masks[mask.texels + (i >> 2u)] >> (8u * (i & 3u))) & 255u) / 255.0;
}

float sampled_alpha(RayMask mask, vec2 uv) {
    vec2 at = uv * vec2(mask.width, mask.height);
    if (any(isnan(at)) || any(isinf(at))) return 1.0;
    vec2 first = mask.linear ? floor(at - 0.5) : floor(at);
    vec2 part = mask.linear ? at - 0.5 - first : vec2(0.0);
    vec2 above = vec2(mask_alpha(mask, first), mask_alpha(mask, first + vec2(1.0, 0.0)));
    vec2 below = vec2(mask_alpha(mask, first + vec2(0.0, 1.0)), mask_alpha(mask, first + vec2(1.0)));
    vec2 rows = mix(above, below, part.y);
    return mix(rows.x, rows.y, part.x);
}

// Returns whether the material is there. `mask` and `uvs`: as a RayTriangle has them.
bool is_there(uint mask, uint uvs, vec3 weights) {
    RayMask m = ray_mask(mask);
    float alpha = m.alpha;
    if (m.texels != kNoMaskTexture)
        alpha *= sampled_alpha(m, weights.x * mask_uv(uvs) + weights.y * mask_uv(uvs + 2u) + weights.z * mask_uv(uvs + 4u));
    if (m.coloured)
        alpha *= weights.x * corner_alpha(uvs, 0u) + weights.y * corner_alpha(uvs, 1u) + weights.z * corner_alpha(uvs, 2u);
    return alpha >= m.cutoff;
}

// Returns twice the area of a mask's texels on a triangle.
float mask_area_texel2(RayMask mask, uint uvs) {
    vec2 size = vec2(mask.width, mask.height), corner = mask_uv(uvs);
    vec2 ab = size * (mask_uv(uvs + 2u) - corner), ac = size * (mask_uv(uvs + 4u) - corner);
    return abs(ab.x * ac.y - ab.y * ac.x);
}

// Returns whether the parts that the mask leaves of a triangle are on average at least as wide as the map's texels.
// Narrower parts lie between texels' middles as often as under them. A test of the triangles that texels show would
// miss them, but the nearest texel's depth covers the right share. `area_m2`: twice the triangle's area across the ray.
bool is_resolved(uint at, uint uvs, float area_m2, float texel_m2) {
    RayMask mask = ray_mask(at);
    return mask.texels == kNoMaskTexture || mask_area_texel2(mask, uvs) * texel_m2 <= mask.chord_texel * mask.chord_texel * area_m2;
}
