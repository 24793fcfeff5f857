// Test of a ray against a triangle in double, with corners relative to where the ray begins. Twin of
// engine/rays/exact_triangle.h.
struct ExactHit {
    bool met;
    vec3 weights;   // barycentric weights of the corners a, b, c
};

// Returns the side of an edge on which the ray passes. It is antisymmetric in p and q to the last bit: no ray slips
// between two triangles with a common edge. `precise`: a fused product would be rounded otherwise the other way round.
double exact_side_of_edge(dvec3 along, dvec3 p, dvec3 q) {
    precise dvec3 edge = q - p, sum = p + q;
    precise double x = edge.y * sum.z - edge.z * sum.y;
    precise double y = edge.z * sum.x - edge.x * sum.z;
    precise double z = edge.x * sum.y - edge.y * sum.x;
    precise double side = along.x * x + along.y * y + along.z * z;
    return side;
}

// Returns whether the ray meets the triangle at t in (0, last) times `along`. A triangle is where the receiver is if its
// plane holds the receiver to within error_m. It then does not stand in its way: a line meets a plane once. Nor does a
// triangle with the receiver between its plane and the light. Not a number, or no area: not met.
// `receiver`: from the ray's beginning.
ExactHit meets_exactly(dvec3 along, float last, dvec3 a, dvec3 b, dvec3 c, dvec3 receiver, float error_m) {
    dvec3 sides = dvec3(exact_side_of_edge(along, b, c), exact_side_of_edge(along, c, a), exact_side_of_edge(along, a, b));
    dvec3 normal = cross(b - a, c - a);
    double slope = dot(normal, along), height = dot(normal, a), rounding = double(error_m) * length(normal);
    double of_receiver = height - dot(normal, receiver);
    bool inside = all(greaterThanEqual(sides, dvec3(0.0))) || all(lessThanEqual(sides, dvec3(0.0)));
    bool ahead = slope > 0.0 ? height > 0.0 && of_receiver > rounding : slope < 0.0 && height < 0.0 && of_receiver < -rounding;
    bool before_end = last >= kNoEnd || (slope > 0.0 ? height < double(last) * slope : height > double(last) * slope);
    return ExactHit(inside && ahead && before_end, vec3(sides / (sides.x + sides.y + sides.z)));
}
