// Conservative test of a ray against boxes: a box that is missed may count as met, never the other way round.

// Bound on rounding, units of 2^-24 of the largest coordinate. It covers the sum of
// - where the ray begins: 4;
// - the ray's direction, over the distance to the box: 4;
// - each slab's distance: 3, on up to three times that coordinate;
// - kLeastAlong below: 2.
const float kBoxUnits = 32.0;
// Least component of the direction, as a share of the largest. A smaller one moves no point of the way by more than the
// slack holds, and its inverse is finite.
const float kLeastAlong = 5.9604645e-8;   // 2^-24

const float kNoEnd = 3.0e38;   // from here on a ray's last t stands for no end

struct BoxRay {
    vec3 from_low, from_high;   // the ray's beginning, moved by the slack: widens every box
    vec3 inverse;               // 1 / direction, per component
};

BoxRay box_ray(vec3 from, vec3 along, float slack) {
    float least = kLeastAlong * max(max(abs(along.x), abs(along.y)), abs(along.z));
    vec3 kept = mix(along, vec3(least), lessThan(abs(along), vec3(least)));
    return BoxRay(from + slack, from - slack, 1.0 / kept);
}

// Returns whether the ray meets a box for t in [0, last].
bool meets_box(BoxRay ray, vec3 low, vec3 high, float last) {
    vec3 one = (low - ray.from_low) * ray.inverse, other = (high - ray.from_high) * ray.inverse;
    vec3 first = min(one, other), end = max(one, other);
    return max(max(first.x, first.y), max(first.z, 0.0)) <= min(min(end.x, end.y), min(end.z, last));
}
