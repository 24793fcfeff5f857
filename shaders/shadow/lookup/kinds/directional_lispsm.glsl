// Directional light whose maps are warped: cascades as ever, another bias.
#define SHADOW_WARPED
#include "shadow/lookup/kinds/directional.glsl"
