// Returns the way from a point to the light. Lamp: the way to the place from which its shadows are computed, metres.
// Sun: a unit vector.
vec3 toward_light(vec3 position_ca) {
    if (kIsSun) return light.to_light.xyz;
    precise vec3 lamp_ca = light.position.xyz + light.low.xyz;
    return lamp_ca - position_ca;
}

// Returns the area of a texel across the light at that distance, m². `texel`: its sides, metres of a sun's map, else
// tangents.
float texel_area_m2(vec2 texel, vec3 toward_light_m) {
    if (kIsSun) return texel.x * texel.y;
    return texel.x * texel.y * dot(toward_light_m, toward_light_m);
}
