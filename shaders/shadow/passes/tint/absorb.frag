// Absorbance up to each layer of translucent casters, itself included; drawn as a sum over all surfaces. The last layer
// has that of all surfaces behind it as well.
#include "shadow/passes/tint/absorbance.glsl"
#include "shadow/passes/tint/surface_transmittance.glsl"
#include "shadow/passes/tint/caster_depth.glsl"
layout(location = kUvVarying) in vec2 fragment_uv;
layout(binding = kPeeledDepthUnit) uniform sampler2D layer_depths[4];
layout(location = 0) out vec4 first_out;
layout(location = 1) out vec4 second_out;
layout(location = 2) out vec4 third_out;
layout(location = 3) out vec4 last_out;

void main() {
    vec4 absorbed = vec4(absorbance_of(surface_transmittance(fragment_uv)), 0.0);
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float depth = caster_depth();
    first_out = depth >= texelFetch(layer_depths[0], texel, 0).r ? absorbed : vec4(0.0);
    second_out = depth >= texelFetch(layer_depths[1], texel, 0).r ? absorbed : vec4(0.0);
    third_out = depth >= texelFetch(layer_depths[2], texel, 0).r ? absorbed : vec4(0.0);
    last_out = absorbed;
}
