// Share of light that passes through a translucent surface, per channel. It is all of it where the surface covers
// nothing, else what its material transmits, tinted by its colour.
// C++ twin: TransmissionRecord in systems/shadow/passes/tint_pass.h.
#include "common/material.glsl"
layout(std140, binding = kTransmissionBlock) uniform TransmissionBlock {
    vec4 through;   // rgb: share that passes where the surface covers; w: 1: its alpha is the covered share
} transmission;

vec3 surface_transmittance(vec2 uv) {
    vec4 colour = material_colour(uv);
    float covered = transmission.through.w > 0.5 ? clamp(colour.a, 0.0, 1.0) : 1.0;
    if (cut_out(uv)) covered = 0.0;
    vec3 tinted = clamp(transmission.through.rgb * colour.rgb * (1.0 - material.metallic), 0.0, 1.0);
    return 1.0 - covered * (1.0 - tinted);
}
