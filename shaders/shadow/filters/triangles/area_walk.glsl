// Triangles over an area: what texels around it show, and the neighbours in the mesh as far as they overlap it. They
// darken the places behind them.
#include "shadow/filters/triangles/area_places.glsl"
#include "shadow/filters/triangles/visited.glsl"

// Triangles that texels show: four around the receiver, and blocks of four around its pixel's area.
struct ShownTriangles { FourTriangles inner, a, b, c, d; };

// Most triangles of a pixel.
const int kMostOverArea = 20;
// Most triangles in a row that lie beside the area, on the way to it.
const int kMostBeside = 1;

// Returns the triangle of the lowest bit.
uvec2 start_at(ShownTriangles shown, int bits) {
    if ((bits & 0xf) != 0) return shown_at(shown.inner, bits);
    if ((bits & 0xf0) != 0) return shown_at(shown.a, bits >> 4);
    if ((bits & 0xf00) != 0) return shown_at(shown.b, bits >> 8);
    if ((bits & 0xf000) != 0) return shown_at(shown.c, bits >> 12);
    return shown_at(shown.d, bits >> 16);
}

int bits_of(bvec4 which) { return int(dot(vec4(which), vec4(1.0, 2.0, 4.0, 8.0))); }

int four_showing(FourTriangles shown, uvec2 triangle) {
    return bits_of(equal(shown.triangle, uvec4(triangle.y))) & bits_of(equal(shown.instance, uvec4(triangle.x)));
}

// Returns the bits that show a triangle.
int texels_showing(ShownTriangles shown, uvec2 triangle) {
    return four_showing(shown.inner, triangle) | four_showing(shown.a, triangle) << 4 | four_showing(shown.b, triangle) << 8 |
           four_showing(shown.c, triangle) << 12 | four_showing(shown.d, triangle) << 16;
}

// Where the way over an area starts.
struct AreaStarts {
    ShownTriangles shown;
    int texels;   // bits of `shown`
    vec2 place;   // the middle's, texels
    uint places;  // bits of places with own texels that start
};

// Goes over the triangles that start and their neighbours: over the edges that places lie beyond which are not dark yet,
// or toward the area. Where a triangle faces the light the other way than the first, the mesh folds back: what lies
// beyond is under what came before.
// One loop takes all triangles, so that neighbouring pixels go in step.
void darken_places(ShadowPoint point, AreaStarts starts, inout AreaPlaces area) {
    vec3 ray = toward_light(point.position_ca), view = to_camera(point.position_ca);
    float error_m = error_along_view_m(point.position_ca, point.normal, point.error_m);
    vec2 texel = shadow_texel_sides(point), right = texels_moved(point, area.right), up = texels_moved(point, area.up);
    bool shows = dot(point.normal, view) > 0.0;
    int left = starts.texels;
    uint places_left = starts.places;
    uvec2 at = left == 0 ? uvec2(0u, kNothing) : start_at(starts.shown, left);   // instance, triangle
    Visited visited = none_visited();
    uvec4 waiting = kNoTriangles;   // neighbours, of the same instance
    int steps = 0, beside = 0;
    float first_faces = 0.0;
    if (left != 0 || places_left != 0u) do {
        left &= ~texels_showing(starts.shown, at);
        visited = with(visited, at);
        bool known = at.y != kNoTriangle && at.y != kNothing;
        InstanceRecord instance = instance_record(at.x);
        CasterTriangle t = caster_triangle(known ? at.y : 0u);
        SeenCorners corners = corners_from(point.position_ca, instance, t);
        vec3 a_ca = corners.a_ca, a = corners.a, b = corners.b, c = corners.c;
        vec3 ab = b - a, ac = c - a;
        vec3 normal = cross(ab, ac);
        vec3 to_light = toward_light(a_ca);
        vec3 sides = max(vec3(length(ab), length(c - b), length(ac)), vec3(kLeastSide_m));
        float faces = dot(normal, to_light);
        bool has_area = known && shows_area(faces, normal, sides, a, to_light);
        faces = has_area ? faces : first_faces;   // it is crossed, and is no fold
        float side = faces < 0.0 ? -1.0 : 1.0;
        first_faces = first_faces == 0.0 ? faces : first_faces;
        vec3 beside_ab = cross(a, b), beside_bc = cross(b, c), beside_ca = cross(c, a);
        vec3 inside = side * vec3(dot(ray, beside_ab), dot(ray, beside_bc), dot(ray, beside_ca));
        float behind = side * dot(normal, a);
        float rounding = error_m * length(normal) + kPlaneRounding * sides.x * sides.z * length(a);
        bool averted = shows && faces * dot(normal, view) < 0.0;
        float above = max(dot(point.normal, a), max(dot(point.normal, b), dot(point.normal, c)));
        bool darkens = behind > rounding || (behind > 0.0 && averted && above > error_m);
        AreaEdges edges = area_edges(area, inside, behind - rounding, side, normal, mat3(ab, c - b, -ac),
                                     mat3(beside_ab, beside_bc, beside_ca));
        vec3 reach = 0.5 * (abs(edges.right.xyz) + abs(edges.up.xyz)), most = edges.middle.xyz + reach;
        bool overlaps = has_area && min(most.x, min(most.y, most.z)) >= 0.0;
        bool masked = kHasMasks && t.across_ab == kMaskedTriangle;
        // Loops, since software devices run what is in an `if` for every pixel.
        PlacesOf places = PlacesOf(0u, uvec3(0u));
        for (int once = overlaps ? 1 : 0; once > 0; --once) places = places_of(edges);
        if (darkens && !masked) area.dark |= places.inside;
        if (kHasMasks) {
            float area_m2 = abs(dot(normal, ray)) / length(ray);
            int verdict = masked && behind > rounding ? masked_verdict(t, inside, area_m2, texel_area_m2(texel, to_light)) : kPasses;
            area.unknown = area.unknown || verdict == kUnknown;
            uint by_mask = masked && behind > rounding && verdict != kUnknown ? places.inside & ~area.dark : 0u;
            for (; by_mask != 0u; by_mask &= by_mask - 1u)
                if (is_there(t.across_bc, t.across_ca, weights_at(edges, by_mask))) area.dark |= by_mask & -by_mask;
        }
        uvec3 across = masked || !known ? uvec3(kNoTriangle) : uvec3(t.across_ab, t.across_bc, t.across_ca);
        // Over edges with lit places beyond, or over the edge that keeps the area out.
        vec3 ways = most / sides;
        const float kShut = 3.0e38;
        bvec3 is_open;
        for (int i = 0; i < 3; ++i) {
            is_open[i] = across[i] != kNoTriangle && !is_among(uvec2(at.x, across[i]), visited);
            ways[i] = is_open[i] ? ways[i] : kShut;
        }
        float way = min(ways.x, min(ways.y, ways.z));
        bvec3 takes;
        for (int i = 0; i < 3; ++i) takes[i] = is_open[i] && (overlaps ? (places.beyond[i] & ~area.dark) != 0u : ways[i] == way);
        beside = overlaps ? 0 : beside + 1;
        if (beside > kMostBeside || first_faces * faces < 0.0) takes = bvec3(false);
        if (takes.x) waiting = uvec4(across.x, waiting.xyz);
        if (takes.y) waiting = uvec4(across.y, waiting.xyz);
        if (takes.z) waiting = uvec4(across.z, waiting.xyz);
        area.unknown = area.unknown || at.y == kNoTriangle;
        ++steps;
        bool waits = waiting.x != kNoTriangle;
        at = waits ? uvec2(at.x, waiting.x) : (left != 0 ? start_at(starts.shown, left) : uvec2(at.x, kNothing));
        beside = waits ? beside : 0;
        first_faces = waits ? first_faces : 0.0;
        waiting = uvec4(waiting.yzw, kNoTriangle);
        places_left &= ~area.dark;
        for (int once = at.y == kNothing && places_left != 0u ? 1 : 0; once > 0; --once) {
            vec2 there = place_in_area(findLSB(places_left));
            places_left &= places_left - 1u;
            FourTriangles four = shadow_triangles_around(point, floor(starts.place + right * there.x + up * there.y));
            at = uvec2(four.instance.y, four.triangle.y);
            if (is_among(at, visited)) at.y = kNothing;
        }
    } while ((at.y != kNothing || places_left != 0u) && steps < kMostOverArea && area.dark != kAllPlaces);
}
