// Counts the picture's pixels by their distance along the view, in bins that are fixed to the metre. Bin i begins at
// 2^(i / 4 - 24) m. C++ twin: systems/extract/sampled_depths.h.
#include "common/bindings.glsl"
#include "common/view_distance.glsl"
layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = kSurfaceDepthUnit) uniform sampler2D surface_depth;
layout(std430, binding = kDepthBinBuffer) buffer DepthBinBuffer { uint depth_bins[]; };
const uint kBins = 256;   // one per invocation
const int kFirstOctave = -24;
const int kSide = 4;      // pixels of an invocation, to either side: kTile_px in systems/lighting/depth_sampler.cpp
shared uint counted[kBins];

// Returns the bin of a distance from the bits of the number: every device puts it into the same bin.
int bin_of(float distance_m) {
    uint bits = floatBitsToUint(distance_m);
    int octave = int(bits >> 23) - 127;
    float mantissa = uintBitsToFloat((bits & 0x007fffffu) | 0x3f800000u);
    int quarter = int(mantissa >= 1.1892071) + int(mantissa >= 1.4142135) + int(mantissa >= 1.6817929);   // 2^(k / 4)
    return clamp((octave - kFirstOctave) * 4 + quarter, 0, int(kBins) - 1);
}

void main() {
    counted[gl_LocalInvocationIndex] = 0u;
    barrier();
    ivec2 size = textureSize(surface_depth, 0);
    ivec2 group = ivec2(gl_WorkGroupSize.xy);
    ivec2 first = ivec2(gl_WorkGroupID.xy) * group * kSide + ivec2(gl_LocalInvocationID.xy);
    for (int k = 0; k < kSide * kSide; ++k) {
        ivec2 pixel = first + group * ivec2(k % kSide, k / kSide);
        if (any(greaterThanEqual(pixel, size))) continue;
        float depth = texelFetch(surface_depth, pixel, 0).r;
        float distance_m = view_distance(depth);
        if (depth > 0.0 && distance_m > 0.0) atomicAdd(counted[bin_of(distance_m)], 1u);
    }
    barrier();
    uint count = counted[gl_LocalInvocationIndex];
    if (count > 0u) atomicAdd(depth_bins[gl_LocalInvocationIndex], count);
}
