// Flat prefiltered maps without mipmaps.
#include "shadow/lookup/maps/flat_levels.glsl"

vec4 shadow_moments(ShadowPoint point) { return textureLod(shadow_map, vec3(point.map.xy, point.layer), 0.0); }
