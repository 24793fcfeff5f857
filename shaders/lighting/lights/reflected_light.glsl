// What a surface reflects of one light, and what falls on it: shares of the light's radiance in LightSample.
#include "lighting/lights/light_sample.glsl"
#include "lighting/lights/brdf.glsl"
#if LIGHT_AREA
#include "lighting/lights/area_light.glsl"

vec3 reflected_share(LightSample incoming, vec3 colour, float metallic, float roughness, vec3 n, vec3 v) {
    return area_reflected(incoming.source, colour, metallic, roughness, n, v);
}

float falling_share(LightSample incoming, vec3 n) { return kPi * area_received(incoming.source, n); }
#else
vec3 reflected_share(LightSample incoming, vec3 colour, float metallic, float roughness, vec3 n, vec3 v) {
    return brdf_times_cosine(colour, metallic, roughness, n, v, incoming.to_light);
}

float falling_share(LightSample incoming, vec3 n) { return max(dot(n, incoming.to_light), 0.0); }
#endif
