// Light of an area light that a surface reflects, by linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt 2016).
// A lobe of brdf.glsl is the part above the surface of a cosine's lobe that is turned and stretched. What a source gives
// is then the integral of a cosine over its transformed outline, which has a closed form (Lambert 1760).
#include "common/bindings.glsl"
#include "lighting/lights/area_outline.glsl"
layout(std430, binding = kAreaTableBuffer) readonly buffer AreaTable { vec4 area_lobes[]; };

const int kLobesAcross = 32;      // C++ twin: bench/area_table/lobe_fit.h
const int kMostClipped = 20;      // a plane cuts an outline at most four times: a tube's may be hollow
const float kSmallOutline = 0.02; // share of its distance up to which an outline counts as a small flat one

// What a vector of a cosine's integral over an outline is: along it, the integral of the cosine over pi.
struct ClippedOutline {
    vec3 corners[kMostClipped];
    int count;
};

// Lobes of a roughness and angle: FittedLobe of bench/area_table/lobe_fit.h.
struct AreaLobes {
    vec4 reflected, grazing;   // lean, along, across, skew
    vec2 size;                 // integrals of both
};

// Returns where an edge meets the plane z = 0.
vec3 at_horizon(vec3 from, vec3 to) {
    vec3 at = from + (to - from) * (from.z / (from.z - to.z));
    at.z = 0.0;
    return at;
}

ClippedOutline with_corner(ClippedOutline outline, vec3 corner) {
    outline.corners[outline.count] = corner;
    outline.count = min(outline.count + 1, kMostClipped - 1);
    return outline;
}

// Adds an edge's end, and where the edge crosses the horizon (Sutherland and Hodgman 1974).
ClippedOutline with_edge(ClippedOutline outline, vec3 from, vec3 to) {
    if ((from.z > 0.0) != (to.z > 0.0)) outline = with_corner(outline, at_horizon(from, to));
    if (to.z > 0.0) outline = with_corner(outline, to);
    return outline;
}

// Returns the angle between two unit vectors by its sine, times their cross product.
vec3 edge_integral(vec3 a, vec3 b) {
    vec3 normal = cross(a, b);
    float cosine = dot(a, b), sine = length(normal);
    float small = 1.0 + sine * sine * (0.1666666667 + sine * sine * 0.075);   // asin(s) / s
    float angle = atan(sine, cosine);
    return normal * (cosine > 0.0 && sine < 0.1 ? small : angle / max(sine, 1e-30));
}

// Returns the integral's vector of an outline above the horizon, that starts anywhere and runs either way.
vec3 outline_integral(ClippedOutline outline) {
    vec3 first = outline.corners[0], sum = vec3(0.0), area = vec3(0.0), middle = vec3(0.0);
    float widest = 0.0;
    for (int i = 0; i < outline.count; ++i) {
        vec3 a = outline.corners[i], b = outline.corners[i + 1 < outline.count ? i + 1 : 0];
        sum += edge_integral(normalize(a), normalize(b));
        area += cross(a - first, b - first);
        middle += a;
        widest = max(widest, length(a - first));
    }
    if (outline.count < 3) return vec3(0.0);
    middle = middle / float(outline.count);
    float distance = max(length(middle), 1e-30);
    const float kInversePi = 0.318309886, kPerTurn = 0.159154943;
    if (widest < kSmallOutline * distance) {
        vec3 toward = middle / distance;
        return toward * (abs(dot(area / distance, toward)) * 0.5 * kInversePi / distance);
    }
    return sum * (sum.z < 0.0 ? -kPerTurn : kPerTurn);
}

ClippedOutline no_outline() {
    ClippedOutline outline;
    outline.count = 0;
    return outline;
}

// Returns the part of the source above the surface, in the axes of `frame`.
ClippedOutline source_outline(AreaSource source, mat3 frame) {
    ClippedOutline outline = no_outline();
    int count = outline_corners();
    vec3 from = outline_corner(source, count - 1) * frame;
    for (int i = 0; i < count; ++i) {
        vec3 to = outline_corner(source, i) * frame;
        outline = with_edge(outline, from, to);
        from = to;
    }
    return outline;
}

// Returns the outline in the cosine's own space.
ClippedOutline transformed_outline(ClippedOutline outline, vec4 lobe, float alpha, float n_v) {
    ClippedOutline out_of = no_outline();
    float turn_rad = alpha * lobe.x - acos(n_v), s = sin(turn_rad), c = cos(turn_rad);
    vec3 from = vec3(0.0);
    for (int i = -1; i < outline.count; ++i) {
        vec3 p = outline.corners[i < 0 ? max(outline.count - 1, 0) : i];
        float ahead = c * p.z - s * p.x;
        float across = (c * p.x + s * p.z - alpha * lobe.w * ahead) / (alpha * lobe.y);
        vec3 to = vec3(across, p.y / (alpha * lobe.z), ahead);
        if (i >= 0) out_of = with_edge(out_of, from, to);
        from = to;
    }
    return out_of;
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
float area_received(AreaSource source, vec3 n) { return outline_integral(source_outline(source, axes_around(n))).z; }

// Returns the radiance that a surface reflects of a source with a luminance of 1: the integral of
// brdf_times_cosine() of brdf.glsl.
vec3 area_reflected(AreaSource source, vec3 colour, float metallic, float roughness, vec3 n, vec3 v) {
    float n_v = clamp(abs(dot(n, v)), 1e-4, 1.0);
    mat3 frame = lobe_frame(n, v);
    ClippedOutline outline = source_outline(source, frame);
    vec3 falls = outline_integral(outline);
    AreaLobes lobes = area_lobes_of(roughness, n_v);
    float alpha = max(roughness * roughness, 1e-3);
    vec3 f0 = mix(vec3(0.04), colour, metallic);
    float f0_mean = (f0.x + f0.y + f0.z) / 3.0, added = (1.0 - f0_mean) * lobes.size.y;
    // One lobe stands for both parts, by their shares.
    vec4 lobe = mix(lobes.reflected, lobes.grazing, added / max(added + f0_mean * lobes.size.x, 1e-30));
    float mirrored = outline_integral(transformed_outline(outline, lobe, alpha, n_v)).z;
    // What a surface does not mirror it scatters: taken for the middle of what falls on it.
    float v_l = dot(v * frame, falls) / max(length(falls), 1e-30);
    vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - sqrt(clamp(0.5 + 0.5 * v_l, 0.0, 1.0)), 5.0);
    vec3 scattered = (1.0 - fresnel) * (1.0 - metallic) * colour * falls.z;
    return scattered + (f0 * lobes.size.x + (1.0 - f0) * lobes.size.y) * mirrored;
}
