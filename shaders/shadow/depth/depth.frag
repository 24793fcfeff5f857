// Opaque casters: the rasteriser's depth is all there is. Masked ones drop what is cut out.
#ifdef MASKED
#include "shared/material.glsl"
in vec2 fragment_uv;
void main() {
    if (material_colour(fragment_uv).a < material.alpha_cutoff) discard;
}
#else
void main() {}
#endif
