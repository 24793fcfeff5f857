// Opaque casters: the rasteriser's depth is all there is. Masked ones drop what is cut out.
#ifdef MASKED
#include "shared/material.glsl"
in vec2 fragment_uv;
void main() {
    if (cut_out(fragment_uv)) discard;
}
#else
void main() {}
#endif
