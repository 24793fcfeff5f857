// Triangles that a walk has visited. Requires shadow/filters/triangles/mesh_walk.glsl.
const uint kNothing = 0xfffffffcu;   // in place of a triangle: there is no next one
const uvec4 kNoTriangles = uvec4(kNoTriangle);

// Triangles that were visited last.
struct Visited { uvec4 last, before, first; };

uint key_of(uvec2 at) { return at.y ^ at.x * 2654435769u; }   // another for nearly every instance and triangle

Visited none_visited() {
    Visited visited;
    visited.last = visited.before = visited.first = kNoTriangles;
    return visited;
}

Visited with(Visited visited, uvec2 at) {
    Visited next;
    next.last = uvec4(key_of(at), visited.last.x, visited.last.y, visited.last.z);
    next.before = uvec4(visited.last.w, visited.before.x, visited.before.y, visited.before.z);
    next.first = uvec4(visited.before.w, visited.first.x, visited.first.y, visited.first.z);
    return next;
}

bool is_among(uvec2 at, Visited visited) {
    uvec4 key = uvec4(key_of(at));
    return any(equal(visited.last, key)) || any(equal(visited.before, key)) || any(equal(visited.first, key));
}

// Returns whether a walk may go over an edge of `at` to what lies across.
bool is_new_beyond(uvec2 at, uint across, Visited visited) {
    return across != kNoTriangle && !is_among(uvec2(at.x, across), visited);
}
