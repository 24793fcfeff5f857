// Pixels of one light for rays: those of which its map is not certain. C++ twin: systems/lighting/ray_list.cpp.
layout(std430, binding = 1) buffer RayListBuffer {
    uint ray_count;
    uint listed_pixels[];   // x, and above its 16 bits y
};
