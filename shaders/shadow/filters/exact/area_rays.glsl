// Share of a pixel's area on its receiver's plane that the light reaches, by a ray from each of its places. Requires
// lit_along() and uncertain_reach().
#include "shadow/passes/prefilter/pixel_footprint.glsl"

// Number of places, and by how many rows they climb per column: a Fibonacci lattice. It is off by 0.015 on average for a
// straight edge of any direction.
const int kRayPlaces = 34, kRowsPerColumn = 21;

// true where an edge crosses the area.
bool shadow_crossed = false;

// Returns where a place lies, pixels from the middle.
vec2 place_of_ray(int i) { return (vec2(i, kRowsPerColumn * i % kRayPlaces) + 0.5) / float(kRayPlaces) - 0.5; }

float shadow_traced(dvec3 position_ca, vec3 normal, float error_m, uvec2 receiver) {
    vec3 middle_ca = vec3(position_ca), right = step_right(middle_ca, normal), up = step_up(middle_ca, normal);
    int lit = 0;
    for (int i = 0; i < kRayPlaces; ++i) {
        vec2 at = place_of_ray(i);
        vec3 beside_m = right * at.x + up * at.y, place_ca = middle_ca + beside_m;
        // A unit for the middle's rounding, and one for the sum's.
        float rounded_m = error_m + 2.0 * kUnitRoundoff * length(place_ca);
        dvec3 along = way_to_light(position_ca + dvec3(beside_m));
        lit += int(lit_along(position_ca, beside_m, along, uncertain_reach(place_ca, rounded_m), error_m, receiver));
    }
    shadow_crossed = lit > 0 && lit < kRayPlaces;
    return float(lit) / float(kRayPlaces);
}
