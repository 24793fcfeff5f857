// Pixels of one light for rays: those of which its map is not certain. C++ twin: systems/lighting/ray_list.cpp.
#include "common/bindings.glsl"
layout(std430, binding = kRayListBuffer) buffer RayListBuffer {
    uint ray_count;
    uint listed_pixels[];   // x, and above its 16 bits y
};
