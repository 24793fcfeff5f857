// Places in the area that a pixel covers on its receiver's plane, and which of them a triangle hides from the light.
// Places inside an edge, as the light sees them, span a tetrahedron of positive volume with the light and the edge. That
// volume is linear in the place: one evaluation at the middle and two slopes give it at all places.
#include "shadow/passes/prefilter/pixel_footprint.glsl"

// Number of places: a bit of an `uint` each. They are a lattice, which is off by 0.015 on average for a straight edge,
// by 0.008 for one along the picture. Random places are off by 0.055.
const int kPlaceCount = 32;
const uint kAllPlaces = 0xffffffffu;

struct AreaPlaces {
    vec3 right, up;           // how far the receiver's plane moves as the pixel moves by one, metres
    vec3 ray_right, ray_up;   // these times the ray to the light
    float lamp;               // 1 for a lamp, 0 for a sun
    uint dark;                // a bit for each place that is hidden from the light
    bool unknown;             // some triangle is finer than texels, or not known
};

// Returns the places of a pixel's area, all of them lit. light.low.w: 0: the area is its middle alone.
AreaPlaces area_places(vec3 position_ca, vec3 normal, vec3 ray) {
    AreaPlaces area;
    area.right = step_right(position_ca, normal) * light.low.w;
    area.up = step_up(position_ca, normal) * light.low.w;
    area.ray_right = cross(area.right, ray);
    area.ray_up = cross(area.up, ray);
    area.lamp = kIsSun ? 0.0 : 1.0;
    area.dark = 0u;
    area.unknown = false;
    return area;
}

// Volumes of a triangle's edges ab, bc and ca, and how far behind its plane a place lies. Each is given at the middle,
// with its slopes across the area.
struct AreaEdges { vec4 middle, right, up; };

// sides: b - a, c - b and a - c. beside: a times b, b times c and c times a, relative to the middle. side: 1 or -1, which
// turns the triangle toward the light. behind: of the middle, times the length of `normal`, which has any length.
AreaEdges area_edges(AreaPlaces area, vec3 inside, float behind, float side, vec3 normal, mat3 sides, mat3 beside) {
    vec3 right = area.ray_right * sides - area.lamp * (area.right * beside);
    vec3 up = area.ray_up * sides - area.lamp * (area.up * beside);
    vec2 nearer = -vec2(dot(normal, area.right), dot(normal, area.up));
    return AreaEdges(vec4(inside, behind), side * vec4(right, nearer.x), side * vec4(up, nearer.y));
}

// Places behind a triangle, and those beyond one of its edges alone: ab, bc, ca. A bit each.
struct PlacesOf { uint inside; uvec3 beyond; };

// Adds four places, as the bits from `first` on.
void add_four(AreaEdges edges, vec4 x, vec4 y, int first, inout PlacesOf places) {
    vec4 ab = edges.middle.x + edges.right.x * x + edges.up.x * y, bc = edges.middle.y + edges.right.y * x + edges.up.y * y;
    vec4 ca = edges.middle.z + edges.right.z * x + edges.up.z * y, behind = edges.middle.w + edges.right.w * x + edges.up.w * y;
    const vec4 kBits = vec4(1.0, 2.0, 4.0, 8.0);
    vec4 in_ab = vec4(greaterThanEqual(ab, vec4(0.0))), in_bc = vec4(greaterThanEqual(bc, vec4(0.0))), in_ca = vec4(greaterThanEqual(ca, vec4(0.0)));
    vec4 both = in_bc * in_ca;
    places.inside |= uint(dot(in_ab * both * vec4(greaterThanEqual(behind, vec4(0.0))), kBits)) << first;
    places.beyond |= uvec3(dot(both - in_ab * both, kBits), dot((in_ab - in_ab * in_bc) * in_ca, kBits), dot((in_bc - both) * in_ab, kBits)) << first;
}

// Places are numbered by columns of four. Returns those of one column: their distances from the middle of the area, in
// pixels. Each has a row of its own.
vec4 place_columns(float column) { return vec4(-0.484375, -0.453125, -0.421875, -0.390625) + 0.125 * column; }
vec4 place_rows(float column) { return fract(vec4(0.015625, 0.296875, 0.578125, 0.859375) + 0.125 * column) - 0.5; }

// Returns all places of a triangle.
PlacesOf places_of(AreaEdges edges) {
    PlacesOf places = PlacesOf(0u, uvec3(0u));
    add_four(edges, place_columns(0.0), place_rows(0.0), 0, places);
    add_four(edges, place_columns(1.0), place_rows(1.0), 4, places);
    add_four(edges, place_columns(2.0), place_rows(2.0), 8, places);
    add_four(edges, place_columns(3.0), place_rows(3.0), 12, places);
    add_four(edges, place_columns(4.0), place_rows(4.0), 16, places);
    add_four(edges, place_columns(5.0), place_rows(5.0), 20, places);
    add_four(edges, place_columns(6.0), place_rows(6.0), 24, places);
    add_four(edges, place_columns(7.0), place_rows(7.0), 28, places);
    return places;
}

// Returns where a place lies, pixels from the middle.
vec2 place_in_area(int i) { return (vec2(i, 9 * i & kPlaceCount - 1) + 0.5) / float(kPlaceCount) - 0.5; }

// Returns the weights of a triangle's corners at the place of the lowest bit.
vec3 weights_at(AreaEdges edges, uint places) {
    vec2 place = place_in_area(findLSB(places));
    vec4 inside = edges.middle + edges.right * place.x + edges.up * place.y;
    return vec3(inside.y, inside.z, inside.x) / (inside.x + inside.y + inside.z);
}

// Returns the share of the places that is lit.
float lit_places(AreaPlaces area) { return 1.0 - float(bitCount(area.dark)) / float(kPlaceCount); }
