// Depths of one layer of translucent casters: the nearest surfaces, or those behind the layer before (PEELED).
// Everitt 2001, "Interactive order-independent transparency". Surfaces at the same depth are one layer.
#include "shadow/passes/tint/absorbance.glsl"
#include "shadow/passes/tint/surface_transmittance.glsl"
#include "shadow/passes/tint/caster_depth.glsl"
layout(location = kUvVarying) in vec2 fragment_uv;
#ifdef PEELED
layout(binding = kPeeledDepthUnit) uniform sampler2D layer_before;
bool is_peeled(float depth) { return depth >= texelFetch(layer_before, ivec2(gl_FragCoord.xy), 0).r; }
#else
bool is_peeled(float depth) { return false; }
#endif

void main() {
    vec3 absorbed = absorbance_of(surface_transmittance(fragment_uv));
    float depth = caster_depth();
    if (absorbed == vec3(0.0) || is_peeled(depth)) discard;
    gl_FragDepth = depth;
}
