// Curve from exposed radiance to what a display shows. It is rational, through (0,0) with slope 1, reaches 1 at kWhite
// and is constant beyond (Reinhard et al. 2002, eq. 4).
const float kWhite = 8.0;

// Returns what a display shows. What is no number is white: it comes of sums beyond what the picture's numbers hold.
vec3 tone_curve(vec3 exposed) {
    vec3 x = max(mix(vec3(kWhite), exposed, lessThan(exposed, vec3(kWhite))), vec3(0.0));
    return x * (1.0 + x / (kWhite * kWhite)) / (1.0 + x);
}

// Returns the exposed radiance that is shown as `shown`, of [0,1].
vec3 exposed_as(vec3 shown) {
    vec3 y = clamp(shown, 0.0, 1.0), less = 1.0 - y;
    return 2.0 * y / (less + sqrt(less * less + y * (4.0 / (kWhite * kWhite))));
}
