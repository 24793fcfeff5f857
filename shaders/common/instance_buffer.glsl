// Instances, read as texels. Software devices find four numbers of a texel at once, but the numbers of a storage buffer
// one by one. That took more than half of a frame. bench/glsl_on_cpu/overrides has a twin of this file for text that is
// compiled as C++.
#include "common/bindings.glsl"
layout(binding = kInstanceUnit) uniform usamplerBuffer instance_texels;   // four of an InstanceRecord each

InstanceRecord instance_record(uint instance) {
    int texel = 4 * int(instance);
    return InstanceRecord(uintBitsToFloat(texelFetch(instance_texels, texel)), uintBitsToFloat(texelFetch(instance_texels, texel + 1)),
                          uintBitsToFloat(texelFetch(instance_texels, texel + 2)), uintBitsToFloat(texelFetch(instance_texels, texel + 3)));
}
