// Certainty of a light without a map: rays decide everywhere, all the way.
const int kCertainlyLit = 0, kCertainlyDark = 1, kUncertain = 2;

int certainty(vec3 position_ca, float error_m, uvec2 receiver) { return kUncertain; }

float uncertain_reach(vec3 position_ca, float error_m) { return kNoEnd; }
