// Fraction of the light that reaches a surface, as the picture's pixels saw it when it was last looked up:
// systems/lighting/kept_visibility.h.
#include "common/bindings.glsl"
#include "lighting/edges/middle_state.glsl"
#include "lighting/lights/light_sample.glsl"
layout(binding = kKeptVisibilityUnit) uniform sampler2D kept_visibility;
// C++ twin: KeptRecord in systems/lighting/edge_pass.h.
layout(std140, binding = kKeptBlock) uniform KeptBlock {
    ivec4 area;   // xy: first pixel of the picture's rectangle with kept values; zw: its size, pixels
} kept;

// Returns the kept share; 0 beyond the area, which the light does not reach.
float kept_share(ivec2 pixel) {
    ivec2 texel = pixel - kept.area.xy;
    bool inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, kept.area.zw));
    return inside ? share_of(texelFetch(kept_visibility, texel, 0).r) : 0.0;
}

float visible_share(Surface surface, LightSample incoming) { return kept_share(ivec2(gl_FragCoord.xy)); }
