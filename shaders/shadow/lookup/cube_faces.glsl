// Faces of OpenGL's cube: which one a direction falls on, and how it lies.

// Returns the largest of the components' absolute values.
float largest(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// Returns the number of the face that a direction falls on, in OpenGL's order.
int face_of(vec3 direction) {
    vec3 size = abs(direction);
    bool x_major = size.x >= size.y && size.x >= size.z;
    bool y_major = !x_major && size.y >= size.z;
    float along = x_major ? direction.x : (y_major ? direction.y : direction.z);
    return (x_major ? 0 : (y_major ? 2 : 4)) + (along < 0.0 ? 1 : 0);
}

// Returns the axes (u, v, back) of the face that a direction falls on, by OpenGL's table. C++ twin: cube_face().
mat3 face_axes(vec3 direction) {
    vec3 size = abs(direction);
    if (size.x >= size.y && size.x >= size.z) {
        float side = direction.x < 0.0 ? -1.0 : 1.0;
        return mat3(vec3(0.0, 0.0, -side), vec3(0.0, -1.0, 0.0), vec3(-side, 0.0, 0.0));
    }
    if (size.y >= size.z) {
        float side = direction.y < 0.0 ? -1.0 : 1.0;
        return mat3(vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, side), vec3(0.0, -side, 0.0));
    }
    float side = direction.z < 0.0 ? -1.0 : 1.0;
    return mat3(vec3(side, 0.0, 0.0), vec3(0.0, -1.0, 0.0), vec3(0.0, 0.0, -side));
}
