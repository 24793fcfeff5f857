// Casters without masks: all of a triangle is there. It takes the place of ray_tracing/alpha_mask.glsl.
const bool kHasMasks = false;

bool is_there(uint mask, uint uvs, vec3 weights) { return true; }

bool is_resolved(uint mask, uint uvs, float area_m2, float texel_m2) { return true; }
