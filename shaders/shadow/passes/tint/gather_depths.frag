// Depths of all layers of translucent casters in one texel, nearest to the light first. 0: there is no such layer.
#include "common/bindings.glsl"
layout(binding = kPeeledDepthUnit) uniform sampler2D layer_depths[4];
layout(location = 0) out vec4 depths_out;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    depths_out = vec4(texelFetch(layer_depths[0], texel, 0).r, texelFetch(layer_depths[1], texel, 0).r,
                      texelFetch(layer_depths[2], texel, 0).r, texelFetch(layer_depths[3], texel, 0).r);
}
