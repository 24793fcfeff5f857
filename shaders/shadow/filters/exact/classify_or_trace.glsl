// Returns the share of the light by the map where it is certain, else by rays: where no list of rays is kept. Requires
// shadow_ray(), certainty() and uncertain_reach().
float shadow_traced(dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    vec3 rounded_ca = vec3(position_ca);
    float rounded_m = error_m + kUnitRoundoff * length(rounded_ca);
    int verdict = certainty(rounded_ca, rounded_m, receiver);
#if LIGHT_AREA
    // The map sees from the source's middle: it is certain of nothing that turns away from it.
    if (!(dot(vec3(way_to_light(position_ca)), normal) > 0.0)) verdict = kUncertain;
#endif
    if (verdict != kUncertain) return verdict == kCertainlyLit ? 1.0 : 0.0;
    return shadow_ray(uncertain_reach(rounded_ca, rounded_m), position_ca, normal, error_m, receiver);
}
