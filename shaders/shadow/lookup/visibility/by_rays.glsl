// Visibility of a light by rays.

// Returns the visibility of a place that lies exactly on a triangle. `receiver`: its instance and triangle.
float shadow_visibility_at(dvec3 position_ca, vec3 normal, uvec2 receiver) { return shadow_traced(position_ca, normal, 0.0, receiver); }

float shadow_visibility(vec3 position_ca, vec3 normal, float error_m) {
    return shadow_traced(dvec3(position_ca), normal, error_m, kNoReceiver);
}
