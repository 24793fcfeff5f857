// Vectors along the axes of the view that serves a point, and that view's map. Requires the light's kind.

#ifdef SHADOW_CUBE
// Returns a vector's parts along u, v and the way toward the light, in the point's face.
vec3 in_view(ShadowPoint point, vec3 v) { return turned_back(v) * face_axes(point.position); }

float view_distance_m(ShadowPoint point) { return largest(point.position); }

// Returns whether a place is beyond what the map holds. Faces have neighbours.
bool is_beyond_map(vec2 place) { return false; }
#else
// Returns a vector's parts along u, v and the way toward the light, in the point's view.
vec3 in_view(ShadowPoint point, vec3 v) {
    ViewRecord view = light.views[point.view];
    return vec3(dot(v, view.axis_u.xyz), dot(v, view.axis_v.xyz), dot(v, view.axis_back.xyz));
}

float view_distance_m(ShadowPoint point) {
    ViewRecord view = light.views[point.view];
    return view.axis_back.w / max(point.reference - view.numeric.z, 1e-30);
}

bool is_beyond_map(vec2 place) { return min(place.x, place.y) < 0.0 || max(place.x, place.y) >= shadow_map_size().x; }
#endif
