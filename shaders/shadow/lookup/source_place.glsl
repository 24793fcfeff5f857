// Places of an area light as a receiver sees them. C++ twin: systems/extract/source_place.h, which derives them.
// Requires shadow/lookup/light_block.glsl and row_flags.glsl.
const int kSourceView = 7;   // view that carries the source. C++ twin: systems/shadow/frame/view_limits.h
const float kBeforeSource = 1.0 - 1.0 / 1048576.0;   // share of the way to the source at which a ray ends

// Source, from a receiver. half_width_m: radius of a round one; half_height_m: also radius of a tube.
struct AreaSource {
    vec3 middle_m;           // way to its middle
    vec3 right, up, back;
    float half_width_m, half_height_m;
};

struct SourcePlace {
    vec3 offset_m;   // from the source's middle
    float weight;    // share of the light that falls across the way to it; 0: it cannot be seen from there
};

AreaSource source_seen(vec3 to_middle_m) {
    ViewRecord of = light.views[kSourceView];
    AreaSource source;
    source.middle_m = to_middle_m;
    source.right = of.axis_u.xyz;
    source.up = of.axis_v.xyz;
    source.back = light.to_light.xyz;
    source.half_width_m = of.axis_u.w;
    source.half_height_m = of.axis_v.w;
    return source;
}

// Returns a place of a surface. facing_m: the cosine at the source times the distance.
SourcePlace on_surface(AreaSource source, vec3 offset_m, float facing_m) {
    vec3 way_m = source.middle_m + offset_m;
    float distance_m = max(length(way_m), 1e-30);
    SourcePlace place;
    place.offset_m = offset_m;
    place.weight = max(facing_m / distance_m, 0.0) / distance_m / distance_m;
    return place;
}

// Returns two axes across a unit vector.
mat3 axes_around(vec3 toward) {
    vec3 helper = abs(toward.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 right = normalize(cross(toward, helper));
    return mat3(right, cross(toward, right), toward);
}

// Returns the near side of a sphere, within the cone around it.
SourcePlace on_sphere(AreaSource source, vec2 at) {
    float distance_m = max(length(source.middle_m), 1e-30), sine = min(source.half_width_m / distance_m, 1.0);
    mat3 axes = axes_around(source.middle_m / distance_m);
    float cap = sine * sine / (1.0 + sqrt(1.0 - sine * sine)), below = min(dot(at, at), 1.0) * cap;
    vec2 across = at * sqrt(cap * (2.0 - below));
    float beside = below * (2.0 - below);
    float way_m = distance_m * (1.0 - below - sqrt(max(sine * sine - beside, 0.0)));
    SourcePlace place;
    place.offset_m = (axes[2] * (1.0 - below) + axes[0] * across.x + axes[1] * across.y) * way_m - source.middle_m;
    place.weight = sine < 1.0 ? 1.0 : 0.0;
    return place;
}

// Returns the way from the receiver across to a tube's axis, metres.
vec3 to_tube_axis(AreaSource source) { return source.middle_m - source.right * dot(source.middle_m, source.right); }

SourcePlace on_tube(AreaSource source, vec2 at) {
    vec3 to_axis_m = to_tube_axis(source);
    float aside_m = max(length(to_axis_m), 1e-30), radius_m = source.half_height_m;
    vec3 nearest = -to_axis_m / aside_m, around = cross(source.right, nearest);
    float turn_rad = acos(min(radius_m / aside_m, 1.0)) * at.y;
    vec3 normal = nearest * cos(turn_rad) + around * sin(turn_rad);
    return on_surface(source, source.right * (source.half_width_m * at.x) + normal * radius_m, aside_m * cos(turn_rad) - radius_m);
}

// Returns the place of the square from -1 to 1 (rectangle, tube) or of the unit disk (disc, sphere).
SourcePlace source_place(AreaSource source, vec2 at) {
    if (kShape == kSphereShape) return on_sphere(source, at);
    if (kShape == kTubeShape) return on_tube(source, at);
    vec3 offset_m = source.right * (source.half_width_m * at.x) + source.up * (source.half_height_m * at.y);
    return on_surface(source, offset_m, dot(source.back, source.middle_m));
}

// Returns the place of the source that is farthest along a unit vector, from its middle.
vec3 source_top(AreaSource source, vec3 n) {
    float x = dot(n, source.right), y = dot(n, source.up), z = dot(n, source.back);
    if (kShape == kSphereShape) return n * source.half_width_m;
    if (kShape == kDiscShape) return (n - source.back * z) * (source.half_width_m / max(sqrt(max(1.0 - z * z, 0.0)), 1e-6));
    vec3 along = source.right * (x < 0.0 ? -source.half_width_m : source.half_width_m);
    if (kShape == kTubeShape) return along + (n - source.right * x) * (source.half_height_m / max(sqrt(max(1.0 - x * x, 0.0)), 1e-6));
    return along + source.up * (y < 0.0 ? -source.half_height_m : source.half_height_m);
}

// Returns how far the source reaches from its middle along a unit vector, metres.
float source_extent(AreaSource source, vec3 n) {
    if (kShape == kSphereShape) return source.half_width_m;
    float x = dot(n, source.right), y = dot(n, source.up), z = dot(n, source.back);
    if (kShape == kDiscShape) return source.half_width_m * sqrt(max(1.0 - z * z, 0.0));
    if (kShape == kTubeShape) return source.half_width_m * abs(x) + source.half_height_m * sqrt(max(1.0 - x * x, 0.0));
    return source.half_width_m * abs(x) + source.half_height_m * abs(y);
}

// Returns whether any of the source can be seen from the receiver at all: it is before its plane, and not within it.
bool is_shone_on(AreaSource source) {
    if (kShape == kSphereShape) return length(source.middle_m) > source.half_width_m;
    if (kShape == kTubeShape) return length(to_tube_axis(source)) > source.half_height_m;
    return dot(source.back, source.middle_m) > 0.0;
}

// Maps the unit disk to the square from -1 to 1, equal areas to equal areas (Shirley and Chiu 1997, inverted). Circles
// become squares.
vec2 disk_to_square(vec2 disk) {
    const float kPerQuarter = 1.273239545;
    bool wide = abs(disk.x) > abs(disk.y);
    float along = wide ? disk.x : disk.y, across = wide ? disk.y : disk.x;
    float ahead = along < 0.0 ? -length(disk) : length(disk);
    float aside = length(disk) * atan(across / max(abs(along), 1e-30)) * kPerQuarter;
    return wide ? vec2(ahead, aside) : vec2(aside, ahead);
}
