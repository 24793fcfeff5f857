// share: of the depth range, 0 to 1. e to the -exponent at its near end, to the exponent at its far end.
float warped(float share, float exponent) { return exp(exponent * (2.0 * share - 1.0)); }
