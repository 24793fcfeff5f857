// Slope of a receiver's plane over the texels of a map, and the steps on it. shadow_slope() of
// shadow/lookup/kinds/map_2d.glsl has the slope alone.

// Returns a row of a matrix, without its last number.
vec3 map_row(mat4 m, int row) { return vec3(m[0][row], m[1][row], m[2][row]); }

// Changes of u, v and depth around a place of a map, along the world's axes and times w there. A plane stays one under
// any projection: its slope follows from two of its directions.
struct MapGradients {
    vec3 along_u, along_v, along_depth;
    vec3 ray;   // along it neither u nor v change
};

MapGradients map_gradients(mat4 map_from_anchor, vec3 map) {
    MapGradients found;
    vec3 along_w = map_row(map_from_anchor, 3);
    found.along_u = map_row(map_from_anchor, 0) - map.x * along_w;
    found.along_v = map_row(map_from_anchor, 1) - map.y * along_w;
    found.along_depth = map_row(map_from_anchor, 2) - map.z * along_w;
    found.ray = cross(found.along_u, found.along_v);
    return found;
}

// Returns how squarely the plane faces the ray, times the ray's length: at least what the normal's error leaves.
float facing_ray(MapGradients around, vec3 normal) {
    float facing = dot(around.ray, normal);
    float least = kNormalError_rad * length(around.ray);
    if (abs(facing) < least) facing = facing < 0.0 ? -least : least;
    return facing;
}

// Returns the step on the plane, over w, that changes u by `step_uv` and v not at all. step_over_v() swaps them.
vec3 step_over_u(MapGradients around, vec3 normal, float facing, float step_uv) {
    return cross(around.along_v, normal) * (step_uv / facing);
}
vec3 step_over_v(MapGradients around, vec3 normal, float facing, float step_uv) {
    return cross(normal, around.along_u) * (step_uv / facing);
}
