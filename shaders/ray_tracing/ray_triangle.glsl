// Verdict of floats on a ray and a triangle, as by judge() in engine/rays/trace.cpp. What they leave open is left
// to ray_tracing/ray_triangle_f64.glsl.
#include "common/float_rounding.glsl"

const int kMisses = 0, kMeets = 1, kUnsure = 2;

// Bound on the rounding of a corner in the ray's frame, units of 2^-24. Each part counts times the square root of
// three, as rows of three are summed. The instance's origin needs less (2 for itself, 7). The last sum comes on top.
// Parts:
// - the frame's axes: 4;
// - their product with the instance's basis: 3;
// - its product with the corner, and their sum: 4.
const float kPlaceUnits = 24.0;
// Rounding of a product of two coordinates and a difference of two such; of a sum of three of these times a third
// coordinate.
const float kSideUnits = 6.0, kHeightUnits = 6.0;
// Rounding of the way's length: a square root and a product, and of what is compared with it.
const float kEndUnits = 6.0;

// Returns whether the ray meets the triangle behind its beginning and before its end, or kUnsure. Corners are given in
// the ray's own frame: it begins in the origin and runs along z, to end_m. Each may be off by error_m.
int meets_triangle(vec3 a, vec3 b, vec3 c, float end_m, float error_m) {
    // Twice the areas that the sides span with the ray, seen along it.
    vec3 sides = vec3(b.x * c.y - b.y * c.x, c.x * a.y - c.y * a.x, a.x * b.y - a.y * b.x);
    vec2 wide = max(max(abs(a.xy), abs(b.xy)), abs(c.xy));
    float across = max(wide.x, wide.y);
    float side_error = (6.0 * error_m + kSideUnits * kUnitRoundoff * across) * max(across, error_m);
    bool above = any(greaterThan(sides, vec3(side_error))), below = any(lessThan(sides, vec3(-side_error)));
    float nearest = min(min(a.z, b.z), c.z), farthest = max(max(a.z, b.z), c.z);
    if ((above && below) || farthest < -error_m || nearest > end_m * (1.0 + kEndUnits * kUnitRoundoff) + error_m) return kMisses;
    // All on one side: then the distance to where it is met, times their sum.
    bool inside = all(greaterThan(sides, vec3(side_error))) || all(lessThan(sides, vec3(-side_error)));
    float sum = abs(sides.x + sides.y + sides.z), reach = max(abs(nearest), abs(farthest));
    float met_at = abs(sides.x) * a.z + abs(sides.y) * b.z + abs(sides.z) * c.z;
    float error = 3.0 * side_error * reach + sum * (2.0 * error_m + kHeightUnits * kUnitRoundoff * reach);
    bool has_end = end_m < kNoEnd;
    float beyond = has_end ? met_at - end_m * sum : -kNoEnd, beyond_error = has_end ? error + end_m * (3.0 * side_error + kEndUnits * kUnitRoundoff * sum) : 0.0;
    if (inside && (met_at < -error || beyond > beyond_error)) return kMisses;
    return inside && met_at > error && beyond < -beyond_error ? kMeets : kUnsure;
}
