// Directional light: orthographic views (cascades), near to far. A point is served by the first whose map holds it, or,
// where maps are meant to stay while the camera moves, by the one of its distance along the view.
#include "shadow/lookup/kinds/map_2d.glsl"

Bias cascade_bias(ViewRecord view, vec3 position_la, vec3 normal, vec3 n_map, float reach_texel, float error_m) {
    return orthographic_bias(view, n_map, reach_texel, error_m);
}

float cascade_range_m(ViewRecord view, vec3 position_la) { return view.axis_back.w; }

#include "shadow/lookup/kinds/cascades.glsl"
