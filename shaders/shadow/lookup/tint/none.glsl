// Tint of a light without translucent casters.
const bool kTinted = false;

vec3 shadow_tint(vec3 position_ca, vec3 normal, float error_m) { return vec3(1.0); }
