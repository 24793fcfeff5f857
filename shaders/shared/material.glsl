// C++ twin: MaterialRecord in systems/extract/gpu_scene.h.
layout(std140, binding = 2) uniform MaterialBlock {
    vec4 base_colour;
    vec4 emissive;
    float metallic;
    float roughness;
    float alpha_cutoff;   // below 0: not masked
    float has_texture;
} material;
layout(binding = 0) uniform sampler2D base_colour_texture;

vec4 material_colour(vec2 uv) {
    return material.has_texture > 0.5 ? material.base_colour * texture(base_colour_texture, uv) : material.base_colour;
}
