// Returns the visibility of a light without shadows: all of it.
float shadow_visibility(vec3 position_ca, vec3 normal, float error_m) { return 1.0; }
