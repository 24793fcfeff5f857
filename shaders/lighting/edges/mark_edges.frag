// Marks the pixels of one light that an edge of its shadow may cross. They keep their depth, all others lose it.
#include "common/bindings.glsl"
#include "lighting/edges/middle_state.glsl"
layout(binding = kKeptVisibilityUnit) uniform sampler2D middles;

float middle_at(ivec2 pixel) { return texelFetch(middles, clamp(pixel, ivec2(0), textureSize(middles, 0) - 1), 0).r; }

// Returns whether two middles, of neighbours, differ. Where one is not reached, no edge of a shadow lies between.
bool differ(float a, float b) { return a >= 0.0 && b >= 0.0 && mod(a, kUndecided) != mod(b, kUndecided); }

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float own = middle_at(pixel);
    bool crossed = false;
    for (int i = 0; i < 9; ++i) {
        float near = middle_at(pixel + ivec2(i % 3, i / 3) - 1);
        crossed = crossed || near >= kUndecided || differ(own, near);
    }
    if (crossed) discard;
}
