// Returns e to the -exponent at the near end of the depth range, to the exponent at its far end. share: of that range,
// 0 to 1.
float warped(float share, float exponent) { return exp(exponent * (2.0 * share - 1.0)); }
