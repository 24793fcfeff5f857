// Pixels of one light for rays: those of which its map is not certain. C++ twin: systems/lighting/ray_list.cpp.
struct ListedRay {
    uint pixel;    // x, and above its 16 bits y
    float reach;   // ShadowRay::reach
};
layout(std430, binding = 1) buffer RayListBuffer {
    uint ray_count;
    ListedRay listed_rays[];
};
