// Directional light: orthographic views (cascades), near to far. The first with a point in its map serves it. Where
// maps are meant to stay while the camera moves, the cascade of the point's view distance serves it.
#include "shadow/lookup/kinds/map_2d.glsl"

Bias cascade_bias(ViewRecord view, vec3 position_la, vec3 normal, vec3 n_map, float reach_texel, float error_m) {
    return orthographic_bias(view, n_map, reach_texel, error_m);
}

float cascade_range_m(ViewRecord view, vec3 position_la) { return view.axis_back.w; }

#include "shadow/lookup/kinds/cascades.glsl"
