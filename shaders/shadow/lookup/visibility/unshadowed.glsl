// Visibility of a light without shadows.
float shadow_visibility(vec3 position_ca, vec3 normal, float error_m) { return 1.0; }
