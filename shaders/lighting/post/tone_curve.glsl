// From exposed radiance to what a display shows: a rational curve through (0,0), slope 1 at 0, that reaches 1 at kWhite and stays there
// (Reinhard et al. 2002, eq. 4).
const float kWhite = 8.0;

// What is no number is white: it comes of sums beyond what the picture's numbers hold.
vec3 tone_curve(vec3 exposed) {
    vec3 x = max(mix(vec3(kWhite), exposed, lessThan(exposed, vec3(kWhite))), vec3(0.0));
    return x * (1.0 + x / (kWhite * kWhite)) / (1.0 + x);
}

// The exposed radiance that is shown as `shown`, of [0,1].
vec3 exposed_as(vec3 shown) {
    vec3 y = clamp(shown, 0.0, 1.0), less = 1.0 - y;
    return 2.0 * y / (less + sqrt(less * less + y * (4.0 / (kWhite * kWhite))));
}
