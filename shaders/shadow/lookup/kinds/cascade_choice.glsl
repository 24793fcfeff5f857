// Cascade by a place's distance along the view that cascades are fitted to. Requires light_block.glsl.

// Returns that distance, metres.
float fitted_distance_m(vec3 position_ca) { return dot(position_ca, light.position.xyz) + light.position.w; }

int cascade_at(float distance_m) {
    int i = 0;
    while (i + 1 < light.options.x && distance_m > light.views[i].anchor_from_camera.w) ++i;
    return i;
}
