// Absorbance of translucent surfaces: the negated binary logarithm of their transmittance, as a share of kMostOctaves,
// in steps of a 16-bit texture. Layers add up by the sum of whole steps: every order of drawing gives the same bits.
const float kMostOctaves = 16.0;   // what lets less than 2^-16 through counts as opaque
const float kSteps = 65535.0;

vec3 absorbance_of(vec3 transmittance) {
    vec3 octaves = -log2(max(transmittance, vec3(exp2(-kMostOctaves))));
    return floor(clamp(octaves / kMostOctaves, 0.0, 1.0) * kSteps + 0.5) / kSteps;
}

vec3 transmittance_of(vec3 absorbance) {
    return mix(exp2(-kMostOctaves * absorbance), vec3(0.0), greaterThanEqual(absorbance, vec3(1.0)));
}
