// Directional light with warped maps: the same cascades, another bias.
#include "shadow/lookup/kinds/map_2d.glsl"
#include "shadow/lookup/bias/lispsm.glsl"
#include "shadow/lookup/kinds/cascades.glsl"
