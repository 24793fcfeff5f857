// Second pass: blurs along v what the first one left in the scratch texture.
#include "common/bindings.glsl"
#include "shadow/passes/prefilter/prefilter_block.glsl"
layout(binding = kPrefilterSourceUnit) uniform sampler2D scratch;
layout(location = 0) out vec4 moments_out;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy) + ivec2(0, moment.place.z);
    int last = textureSize(scratch, 0).y - 1;
    vec4 sum = vec4(0.0);
    for (int i = -moment.place.y; i <= moment.place.y; ++i)
        sum += weight(abs(i)) * texelFetch(scratch, ivec2(texel.x, clamp(texel.y + i, 0, last)), 0);
    moments_out = sum;
}
