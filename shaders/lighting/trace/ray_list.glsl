// Pixels of one light for rays: pixels that its map is not certain of. C++ twin: systems/lighting/ray_list.cpp.
#include "common/bindings.glsl"
layout(std430, binding = kRayListBuffer) buffer RayListBuffer {
    uint ray_count;
    uint listed_pixels[];   // x, and above its 16 bits y
};
