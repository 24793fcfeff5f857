// Outline of an area light, as the receiver sees it. Requires shadow/lookup/source_place.glsl.
const int kMostCorners = 16;
// Corners of a round outline. They lie outside it, so that the areas are the same.
const float kRoundCorners = 16.0;
const float kRoundOutside = 1.013002;   // sqrt(2 pi / (16 sin(2 pi / 16)))

// Returns the number of corners. It depends on the source: of a constant number compilers make as many copies of a loop.
int outline_corners(AreaSource source) {
    int count = kShape == kRectangleShape ? 4 : kMostCorners;
    return source.half_width_m > 0.0 ? count : 0;
}

vec3 round_corner(vec3 middle_m, vec3 right_m, vec3 up_m, int i) {
    const float kTurn = 6.283185307;
    float angle_rad = kTurn * float(i) / kRoundCorners;
    return middle_m + (right_m * cos(angle_rad) + up_m * sin(angle_rad)) * kRoundOutside;
}

// Returns a corner of the circle in which a sphere's cone touches it.
vec3 sphere_corner(AreaSource source, int i) {
    float distance_m = length(source.middle_m), sine = min(source.half_width_m / distance_m, 1.0);
    mat3 axes = axes_around(source.middle_m / distance_m);
    float inner = 1.0 - sine * sine, radius_m = source.half_width_m * sqrt(inner);
    return round_corner(source.middle_m * inner, axes[0] * radius_m, axes[1] * radius_m, i);
}

// Returns a corner of what is seen of a tube's side: half of them around each of its ends.
vec3 tube_corner(AreaSource source, int i) {
    vec3 to_axis_m = to_tube_axis(source);
    float aside_m = length(to_axis_m), radius_m = source.half_height_m;
    vec3 nearest = -to_axis_m / aside_m, around = cross(source.right, nearest);
    int half_count = kMostCorners / 2;
    bool first = i < half_count;
    float share = float(first ? i : kMostCorners - 1 - i) / float(half_count - 1);
    float turn_rad = acos(min(radius_m / aside_m, 1.0)) * (2.0 * share - 1.0);
    vec3 end_m = source.middle_m + source.right * (first ? source.half_width_m : -source.half_width_m);
    return end_m + (nearest * cos(turn_rad) + around * sin(turn_rad)) * radius_m;
}

vec3 outline_corner(AreaSource source, int i) {
    vec3 right_m = source.right * source.half_width_m, up_m = source.up * source.half_height_m;
    if (kShape == kDiscShape) return round_corner(source.middle_m, right_m, up_m, i);
    if (kShape == kSphereShape) return sphere_corner(source, i);
    if (kShape == kTubeShape) return tube_corner(source, i);
    float x = i == 0 || i == 3 ? -1.0 : 1.0, y = i < 2 ? -1.0 : 1.0;
    return source.middle_m + right_m * x + up_m * y;
}
