// Returns the unit vector along v, or `otherwise` where v has no direction: zero, or not finite. What floats can hold
// and not square is scaled first.
vec3 unit_or(vec3 v, vec3 otherwise) {
    const float kLeast = 1e-18, kMost = 1e18;   // with squares that are normal floats
    float size = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if (!(size >= kLeast && size <= kMost)) v /= size;
    float square = dot(v, v);
    return square > 0.0 && square <= 3.0 * kMost * kMost ? normalize(v) : otherwise;
}
