// From a point to the light: all the way to where a lamp's shadows are looked for, a unit toward a sun.
vec3 toward_light(vec3 position_ca) {
    if (kIsSun) return light.to_light.xyz;
    precise vec3 lamp_ca = light.position.xyz + light.low.xyz;
    return lamp_ca - position_ca;
}

// Area of a texel, across the light, of what stands so far from it; `texel`: its sides, metres of a sun's, else tangents.
float texel_area_m2(vec2 texel, vec3 toward_light_m) {
    if (kIsSun) return texel.x * texel.y;
    return texel.x * texel.y * dot(toward_light_m, toward_light_m);
}
