// Light of an area light that a surface reflects, by linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt 2016).
// A lobe of brdf.glsl is the part above the surface of a cosine's lobe that is turned and stretched. What a source gives
// is then the integral of a cosine over its transformed outline, which has a closed form (Lambert 1760). Requires
// common/bindings.glsl.
#include "lighting/lights/area_outline.glsl"
layout(std430, binding = kAreaTableBuffer) readonly buffer AreaTable { vec4 area_lobes[]; };

const int kLobesAcross = 32;      // C++ twin: bench/area_table/lobe_fit.h
const int kMostClipped = 24;      // planes cut an outline twice; a tube's may be hollow, and is then cut four times
const float kSmallOutline = 0.02; // share of its distance up to which an outline counts as a small flat one

// Lobes of a roughness and angle: FittedLobe of bench/area_table/lobe_fit.h.
struct AreaLobes {
    vec4 reflected, grazing;   // lean, along, across, skew
    vec2 size;                 // integrals of both
};

// Sums over the corners of an outline, one after the other. `sum` is the integral's vector: along it, the integral of the
// cosine over pi. `area` and `middle` are for outlines so small that the sum's parts cancel each other.
struct OutlineSum {
    vec3 first, first_unit, last, last_unit;
    vec3 sum, area, middle;
    float widest, count;
};

OutlineSum no_corners() {
    OutlineSum s;
    s.first = s.first_unit = s.last = s.last_unit = s.sum = s.area = s.middle = vec3(0.0);
    s.widest = s.count = 0.0;
    return s;
}

// Returns an edge's part of the integral: the angle between two unit vectors by its sine and a turn, times their cross
// product. The quotient is the rational function of Heitz and Hill 2017, within 2e-6 of it.
vec3 edge_integral(vec3 a, vec3 b) {
    float cosine = dot(a, b), y = abs(cosine);
    float quotient = (0.8543985 + (0.4965155 + 0.0145206 * y) * y) / (3.4175940 + (4.1616724 + y) * y);
    float beyond = 0.5 / sqrt(max(1.0 - cosine * cosine, 1e-7)) - quotient;
    return cross(a, b) * (cosine > 0.0 ? quotient : beyond);
}

OutlineSum with_corner(OutlineSum s, vec3 corner) {
    vec3 unit = corner / max(length(corner), 1e-30);
    bool is_first = s.count == 0.0;
    s.first = is_first ? corner : s.first;
    s.first_unit = is_first ? unit : s.first_unit;
    s.sum += is_first ? vec3(0.0) : edge_integral(s.last_unit, unit);
    s.area += is_first ? vec3(0.0) : cross(s.last - s.first, corner - s.first);
    s.middle += corner;
    s.widest = max(s.widest, length(corner - s.first));
    s.last = corner;
    s.last_unit = unit;
    s.count += 1.0;
    return s;
}

// Returns where an edge meets the plane z = 0.
vec3 at_horizon(vec3 from, vec3 to) {
    vec3 at = from + (to - from) * (from.z / (from.z - to.z));
    at.z = 0.0;
    return at;
}

// Corners of an outline above the horizon.
struct ClippedOutline {
    vec3 corners[kMostClipped];
    int count;
};

// Adds an edge's end, and before it where the edge crosses the horizon (Sutherland and Hodgman 1974).
ClippedOutline with_edge(ClippedOutline outline, vec3 from, vec3 to) {
    if ((from.z > 0.0) != (to.z > 0.0)) {
        outline.corners[outline.count] = at_horizon(from, to);
        ++outline.count;
    }
    if (to.z > 0.0) {
        outline.corners[outline.count] = to;
        ++outline.count;
    }
    return outline;
}

// Returns the integral's vector, with z above 0, as it is of outlines above the horizon.
vec3 outline_integral(OutlineSum s) {
    const float kInverseTwoPi = 0.159154943;
    vec3 sum = s.sum + edge_integral(s.last_unit, s.first_unit);
    vec3 middle = s.middle / max(s.count, 1.0);
    float distance = max(length(middle), 1e-30);
    vec3 toward = middle / distance;
    vec3 small = toward * (abs(dot(s.area / distance, toward)) * kInverseTwoPi / distance);
    vec3 found = s.widest < kSmallOutline * distance ? small : (sum.z < 0.0 ? -sum : sum);
    return s.count < 3.0 ? vec3(0.0) : found;
}

// A lobe as the way to its cosine's own space.
struct LobeSpace {
    float s, c;          // sine and cosine of its turn from the normal
    vec3 by_stretch;     // 1 / width along and across, and the skew
};

LobeSpace lobe_space(vec4 lobe, float alpha, float n_v) {
    float turn_rad = alpha * lobe.x - acos(n_v);
    LobeSpace space;
    space.s = sin(turn_rad);
    space.c = cos(turn_rad);
    space.by_stretch = vec3(1.0 / (alpha * lobe.y), 1.0 / (alpha * lobe.z), alpha * lobe.w);
    return space;
}

vec3 in_lobe(LobeSpace space, vec3 p) {
    float ahead = space.c * p.z - space.s * p.x;
    float across = space.c * p.x + space.s * p.z - space.by_stretch.z * ahead;
    return vec3(across * space.by_stretch.x, p.y * space.by_stretch.y, ahead);
}

// What a source gives: integrals' vectors of its outline as it is, and in a lobe's space.
struct SourceLight {
    vec3 falls, mirrored;
    bool is_cut;   // the horizon of one of both cuts the outline
};

// Returns it without regard to horizons.
SourceLight light_of_all(AreaSource source, mat3 frame, LobeSpace space) {
    OutlineSum falls = no_corners(), mirrored = no_corners();
    vec2 lowest = vec2(1.0), highest = vec2(-1.0);
    for (int i = 0; i < outline_corners(source); ++i) {
        vec3 corner = outline_corner(source, i) * frame, in_space = in_lobe(space, corner);
        falls = with_corner(falls, corner);
        mirrored = with_corner(mirrored, in_space);
        lowest = min(lowest, vec2(corner.z, in_space.z));
        highest = max(highest, vec2(corner.z, in_space.z));
    }
    SourceLight found;
    found.falls = highest.x > 0.0 ? outline_integral(falls) : vec3(0.0);
    found.mirrored = highest.x > 0.0 && highest.y > 0.0 ? outline_integral(mirrored) : vec3(0.0);
    found.is_cut = highest.x > 0.0 && (lowest.x <= 0.0 || (lowest.y <= 0.0 && highest.y > 0.0));
    return found;
}

// Returns it of the part above the surface, and of that part's own above the lobe's horizon.
SourceLight light_of_cut(AreaSource source, mat3 frame, LobeSpace space) {
    ClippedOutline outline, lobe_outline;
    outline.count = lobe_outline.count = 0;
    vec3 from = outline_corner(source, outline_corners(source) - 1) * frame;
    for (int i = 0; i < outline_corners(source); ++i) {
        vec3 to = outline_corner(source, i) * frame;
        outline = with_edge(outline, from, to);
        from = to;
    }
    OutlineSum falls = no_corners(), mirrored = no_corners();
    from = in_lobe(space, outline.corners[max(outline.count - 1, 0)]);
    for (int i = 0; i < outline.count; ++i) {
        vec3 to = in_lobe(space, outline.corners[i]);
        lobe_outline = with_edge(lobe_outline, from, to);
        falls = with_corner(falls, outline.corners[i]);
        from = to;
    }
    for (int i = 0; i < lobe_outline.count; ++i) mirrored = with_corner(mirrored, lobe_outline.corners[i]);
    SourceLight found;
    found.falls = outline_integral(falls);
    found.mirrored = outline_integral(mirrored);
    found.is_cut = false;
    return found;
}

// Returns what the source gives. It is a loop, because software devices run what is in an `if` for every pixel.
SourceLight source_light(AreaSource source, mat3 frame, LobeSpace space) {
    SourceLight found = light_of_all(source, frame, space);
    while (found.is_cut) found = light_of_cut(source, frame, space);
    return found;
}

AreaLobes area_lobes_of(float roughness, float cosine) {
    const float kLast = float(kLobesAcross - 1);
    vec2 at = clamp(vec2(roughness, sqrt(max(1.0 - cosine, 0.0))), 0.0, 1.0) * kLast;
    vec2 low = min(floor(at), vec2(kLast - 1.0)), share = at - low;
    int entry = 3 * (int(low.y) * kLobesAcross + int(low.x));
    AreaLobes lobes;
    lobes.reflected = vec4(0.0);
    lobes.grazing = vec4(0.0);
    lobes.size = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        bool right = i == 1 || i == 3, above = i >= 2;
        float weight = (right ? share.x : 1.0 - share.x) * (above ? share.y : 1.0 - share.y);
        int corner = entry + (right ? 3 : 0) + (above ? 3 * kLobesAcross : 0);
        lobes.reflected += area_lobes[corner] * weight;
        lobes.grazing += area_lobes[corner + 1] * weight;
        lobes.size += vec2(area_lobes[corner + 2].x, area_lobes[corner + 2].y) * weight;
    }
    return lobes;
}

// Returns the axes in which the normal is z, and the viewer lies at negative x.
mat3 lobe_frame(vec3 n, vec3 v) {
    vec3 away = n * dot(n, v) - v;
    vec3 x = dot(away, away) > 1e-10 ? normalize(away) : axes_around(n)[0];
    return mat3(x, cross(n, x), n);
}

// Returns the integral of the cosine over the source above the surface, over pi.
float area_received(AreaSource source, vec3 n) {
    LobeSpace none;
    none.s = 0.0;
    none.c = 1.0;
    none.by_stretch = vec3(1.0, 1.0, 0.0);
    return source_light(source, axes_around(n), none).falls.z;
}

// Returns the radiance that a surface reflects of a source with a luminance of 1: the integral of
// brdf_times_cosine() of brdf.glsl.
vec3 area_reflected(AreaSource source, vec3 colour, float metallic, float roughness, vec3 n, vec3 v) {
    float n_v = clamp(abs(dot(n, v)), 1e-4, 1.0);
    float alpha = max(roughness * roughness, 1e-3);
    AreaLobes lobes = area_lobes_of(roughness, n_v);
    vec3 f0 = mix(vec3(0.04), colour, metallic);
    // One lobe stands for both parts, by their shares.
    float f0_mean = (f0.x + f0.y + f0.z) / 3.0, added = (1.0 - f0_mean) * lobes.size.y;
    vec4 lobe = mix(lobes.reflected, lobes.grazing, added / max(added + f0_mean * lobes.size.x, 1e-30));
    mat3 frame = lobe_frame(n, v);
    SourceLight light_found = source_light(source, frame, lobe_space(lobe, alpha, n_v));
    vec3 falls = light_found.falls;
    // What a surface does not mirror it scatters: taken for the middle of what falls on it.
    float v_l = dot(v * frame, falls) / max(length(falls), 1e-30);
    vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - sqrt(clamp(0.5 + 0.5 * v_l, 0.0, 1.0)), 5.0);
    vec3 scattered = (1.0 - fresnel) * (1.0 - metallic) * colour * falls.z;
    return scattered + (f0 * lobes.size.x + (1.0 - f0) * lobes.size.y) * light_found.mirrored.z;
}
