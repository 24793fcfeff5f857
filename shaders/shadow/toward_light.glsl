// From a point to the light: all the way to a lamp, a unit toward a sun.
vec3 toward_light(vec3 position_ca) {
#ifdef LIGHT_DIRECTIONAL
    return light.to_light.xyz;
#else
    return light.position.xyz - position_ca;
#endif
}
