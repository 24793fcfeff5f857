// Returns a unit vector as two numbers of [-1, 1] (Cigolle et al., "Survey of Efficient Representations for Independent
// Unit Vectors", JCGT 2014). unit_from_octahedral() returns the vector.
vec2 octahedral_from_unit(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 sign_not_zero = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * sign_not_zero;
}
vec3 unit_from_octahedral(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) {
        vec2 sign_not_zero = vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
        n.xy = (1.0 - abs(n.yx)) * sign_not_zero;
    }
    return normalize(n);
}
