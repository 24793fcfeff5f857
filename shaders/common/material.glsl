// C++ twin: MaterialRecord in systems/extract/gpu_scene.h.
#include "common/bindings.glsl"
layout(std140, binding = kMaterialBlock) uniform MaterialBlock {
    vec4 base_colour;
    vec4 emissive;        // w: 1: unlit
    float metallic;
    float roughness;
    float alpha_cutoff;   // below 0: not masked
    float has_texture;
} material;
layout(binding = kBaseColourUnit) uniform sampler2D base_colour_texture;

#ifdef COLOURED
layout(location = kColourVarying) in vec4 fragment_colour;   // vertex colours, interpolated
#else
const vec4 fragment_colour = vec4(1.0);
#endif

vec4 material_colour(vec2 uv) {
    vec4 colour = material.has_texture > 0.5 ? material.base_colour * texture(base_colour_texture, uv) : material.base_colour;
    return colour * fragment_colour;
}

// Returns whether the mask cuts the surface out at `uv`. The finest level decides at any distance, as the surface's own
// edges do. Coarser ones are averages, by which thin leaves vanish, dense ones close up, and every edge moves.
bool cut_out(vec2 uv) {
    if (material.alpha_cutoff < 0.0) return false;
    float alpha = material.base_colour.a;
    if (material.has_texture > 0.5) alpha *= textureLod(base_colour_texture, uv, 0.0).a;
    return alpha * fragment_colour.a < material.alpha_cutoff;
}
