// glTF metallic-roughness: Lambert plus GGX with the height-correlated Smith term (glTF 2.0, appendix B).
const float kPi = 3.14159265358979;

vec3 brdf_times_cosine(vec3 colour, float metallic, float roughness, vec3 n, vec3 v, vec3 l) {
    float n_l = max(dot(n, l), 0.0);
    float n_v = max(abs(dot(n, v)), 1e-4);
    // Units are rounded: a product of two may be above 1, where the power below has no value and the distribution may
    // divide by 0.
    vec3 between = l + v;
    vec3 h = dot(between, between) > 0.0 ? normalize(between) : n;
    float n_h = clamp(dot(n, h), 0.0, 1.0);
    float v_h = clamp(dot(v, h), 0.0, 1.0);
    float alpha = max(roughness * roughness, 1e-3);
    float a2 = alpha * alpha;
    float denominator = n_h * n_h * (a2 - 1.0) + 1.0;
    float distribution = a2 / (kPi * denominator * denominator);
    float smith = 0.5 / max(n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2), 1e-6);
    vec3 f0 = mix(vec3(0.04), colour, metallic);
    vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - v_h, 5.0);
    vec3 diffuse = (1.0 - fresnel) * (1.0 - metallic) * colour / kPi;
    return (diffuse + fresnel * (distribution * smith)) * n_l;
}
