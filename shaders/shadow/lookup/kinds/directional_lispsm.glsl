// Directional light whose maps are warped: cascades as ever, another bias.
#include "shadow/lookup/kinds/map_2d.glsl"
#include "shadow/lookup/bias/lispsm.glsl"
#include "shadow/lookup/kinds/cascades.glsl"
