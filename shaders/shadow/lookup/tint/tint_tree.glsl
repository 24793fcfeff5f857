// Tree of translucent triangles, which rays walk. Positions are from an anchor, given as two floats. C++ twins:
// TintHead, TintTriangle and TintMaterial in systems/visibility/tint_scene.h.
#include "common/bindings.glsl"
layout(std430, binding = kTintBuffer) readonly buffer TintBuffer { uint tint_words[]; };
const uint kTintHeadWords = 12u, kTintNodeWords = 8u, kTintTriangleWords = 29u;
const uint kNoTexels = 0xffffffffu;

struct TintHead {
    vec3 anchor_high, anchor_low;
    uint nodes, triangles;
    float reach_m;
};
// Node in the order of a walk: from node n to n + 1 where its box is met, else to `skip`.
struct TintNode {
    vec3 low, high;
    uint skip, leaf;   // leaf: its first slot * 16 + number of slots; 0: not a leaf
};
struct TintMaterial {
    vec4 base_colour;
    vec3 through;
    bool blended;
    float cutoff, metallic;
    uint texels, width, height, wrap_u, wrap_v;
    bool linear;
};

float tint_float(uint at) { return uintBitsToFloat(tint_words[at]); }
vec3 tint_vec3(uint at) { return vec3(tint_float(at), tint_float(at + 1u), tint_float(at + 2u)); }
vec4 tint_vec4(uint at) { return vec4(tint_vec3(at), tint_float(at + 3u)); }

TintHead tint_head() { return TintHead(tint_vec3(0u), tint_vec3(4u), tint_words[3], tint_words[7], tint_float(8u)); }

TintNode tint_node(uint n) {
    uint at = kTintHeadWords + n * kTintNodeWords;
    return TintNode(tint_vec3(at), tint_vec3(at + 4u), tint_words[at + 3u], tint_words[at + 7u]);
}

TintMaterial tint_material(uint at) {
    return TintMaterial(tint_vec4(at), tint_vec3(at + 4u), tint_words[at + 7u] != 0u, tint_float(at + 8u), tint_float(at + 9u),
                        tint_words[at + 10u], tint_words[at + 11u], tint_words[at + 12u], tint_words[at + 13u], tint_words[at + 14u],
                        tint_words[at + 15u] != 0u);
}

float tint_wrapped(float texel, float edge, uint wrap) {
    if (wrap == 0u) return clamp(texel - edge * floor(texel / edge), 0.0, edge - 1.0);
    float there_and_back = clamp(texel - 2.0 * edge * floor(texel / (2.0 * edge)), 0.0, 2.0 * edge - 1.0);
    if (wrap == 1u) return there_and_back < edge ? there_and_back : 2.0 * edge - 1.0 - there_and_back;
    return clamp(texel, 0.0, edge - 1.0);
}

// Returns a texel of the finest level, its colour linear.
vec4 tint_texel(TintMaterial m, vec2 texel) {
    uint x = uint(tint_wrapped(texel.x, float(m.width), m.wrap_u)), y = uint(tint_wrapped(texel.y, float(m.height), m.wrap_v));
    vec4 stored = unpackUnorm4x8(tint_words[m.texels + y * m.width + x]);
    vec3 steep = pow((stored.rgb + 0.055) / 1.055, vec3(2.4));
    return vec4(mix(steep, stored.rgb / 12.92, lessThanEqual(stored.rgb, vec3(0.04045))), stored.a);
}

vec4 tint_texture(TintMaterial m, vec2 uv) {
    vec2 at = uv * vec2(m.width, m.height);
    if (any(isnan(at)) || any(isinf(at))) return vec4(1.0);
    vec2 first = m.linear ? floor(at - 0.5) : floor(at);
    vec2 part = m.linear ? at - 0.5 - first : vec2(0.0);
    vec4 above = mix(tint_texel(m, first), tint_texel(m, first + vec2(1.0, 0.0)), part.x);
    vec4 below = mix(tint_texel(m, first + vec2(0.0, 1.0)), tint_texel(m, first + vec2(1.0)), part.x);
    return mix(above, below, part.y);
}

// Returns what passes through a triangle at these weights of its corners: surface_transmittance() of
// shadow/passes/tint/surface_transmittance.glsl. `at`: the triangle's words.
vec3 tint_of_triangle(uint at, vec3 weights) {
    TintMaterial m = tint_material(tint_words[at + 10u]);
    vec2 uv = vec2(0.0);
    vec4 colour = vec4(0.0);
    for (uint i = 0u; i < 3u; ++i) {
        uv += weights[i] * vec2(tint_float(at + 11u + 2u * i), tint_float(at + 12u + 2u * i));
        colour += weights[i] * tint_vec4(at + 17u + 4u * i);
    }
    colour *= m.base_colour;
    if (m.texels != kNoTexels) colour *= tint_texture(m, uv);
    float covered = m.blended ? clamp(colour.a, 0.0, 1.0) : 1.0;
    if (m.cutoff >= 0.0 && colour.a < m.cutoff) covered = 0.0;
    vec3 tinted = clamp(m.through * colour.rgb * (1.0 - m.metallic), 0.0, 1.0);
    return 1.0 - covered * (1.0 - tinted);
}
