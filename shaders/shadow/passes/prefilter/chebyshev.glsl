const float kLeastSquare = 1e-37;   // floats below 2^-126 may count as 0

// Returns the largest share of a distribution of this mean and mean square that can lie at `place` or beyond
// (Cantelli's inequality). least: the variance counts as no less; rounding hides smaller ones.
float share_not_before(float mean, float mean_square, float place, float least) {
    float variance = max(max(mean_square - mean * mean, least), kLeastSquare);
    float beyond = max(place - mean, 0.0);
    return variance / (variance + beyond * beyond);
}
