// Both in one, where no list of rays is kept. Bring shadow_ray(), and certainty() if SHADOW_SHEETS.
float shadow_traced(dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
#ifdef SHADOW_SHEETS
    vec3 rounded_ca = vec3(position_ca);
    Certainty found = certainty(rounded_ca, normal, error_m + kUnitRoundoff * length(rounded_ca), receiver);
    if (found.verdict != kUncertain) return found.verdict == kCertainlyLit ? 1.0 : 0.0;
    return shadow_ray(found.reach, position_ca, normal, error_m, receiver);
#else
    return shadow_ray(kNoEnd, position_ca, normal, error_m, receiver);
#endif
}
