// Places of a light's source as a receiver sees them, and which of them casters hide: a bit each. After Schwarz and
// Stamminger, "Bitmask Soft Shadows" (2007), with the casters' triangles.
// A receiver, a place and an edge span a tetrahedron. Its volume is linear in the place: one evaluation at the middle and
// two slopes give it at all places.
const int kPlaceCount = 32;
const uint kAllPlaces = 0xffffffffu;

struct SourcePlaces {
    vec3 middle, right, up;   // way to the source's middle, and half axes: metres; of a sun tangents
    uint above;               // places above the receiver's plane
    uint hidden;
    bool unknown;             // some caster is finer than texels, or has no triangles, or there are too many
};

#if LIGHT_AREA
#include "shadow/filters/pcss/area_axes.glsl"
const bool kOnSquare = kSquarePlaces;

// Returns the source without its places.
SourcePlaces source_without_places(vec3 position_ca) {
    SourceAxes axes = area_axes(position_ca);
    SourcePlaces source;
    source.middle = axes.middle_m;
    source.right = axes.right_m;
    source.up = axes.up_m;
    return source;
}
#else
const bool kOnSquare = false;

SourcePlaces source_without_places(vec3 position_ca) {
    SourcePlaces source;
    source.middle = toward_light(position_ca);
    vec3 toward = normalize(source.middle);
    vec3 helper = abs(toward.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    source.right = light.radiance.w * normalize(cross(toward, helper));
    source.up = cross(toward, source.right);
    return source;
}
#endif

#if SHADOW_SPREAD
#include "shadow/filters/area_spread.glsl"
#include "shadow/filters/pcss/area_radius.glsl"
const bool kSpreads = true;   // receivers of the places are spread over the pixel's area

PixelArea receiver_area(ShadowPoint point) { return pixel_area(point.position_ca, point.normal); }

float receiver_radius_texel(ShadowPoint point) { return area_radius_texel(point); }
#else
const bool kSpreads = false;
struct PixelArea { vec3 right, up; };

PixelArea receiver_area(ShadowPoint point) {
    PixelArea area;
    area.right = area.up = vec3(0.0);
    return area;
}

float receiver_radius_texel(ShadowPoint point) { return 0.0; }
#endif

// Returns places in half axes, along the first one: four for each `column` of 0 to 7. A straight edge over a
// disk is off by 0.007 on average; over a square, with a lattice of places, by 0.015.
vec4 places_x(int column) {
    if (kOnSquare) return vec4(-0.96875, -0.90625, -0.84375, -0.78125) + 0.25 * float(column);
    if (column == 0) return vec4(-0.924, -0.765, -0.703, -0.697);
    if (column == 1) return vec4(-0.627, -0.550, -0.409, -0.387);
    if (column == 2) return vec4(-0.358, -0.350, -0.275, -0.201);
    if (column == 3) return vec4(-0.195, -0.123, -0.103, -0.044);
    if (column == 4) return vec4(-0.011, 0.059, 0.147, 0.213);
    if (column == 5) return vec4(0.231, 0.252, 0.257, 0.377);
    if (column == 6) return vec4(0.397, 0.490, 0.524, 0.577);
    return vec4(0.647, 0.758, 0.796, 0.891);
}

// Returns them along the second one.
vec4 places_y(int column) {
    if (kOnSquare) return 2.0 * fract(vec4(0.015625, 0.296875, 0.578125, 0.859375) + 0.125 * float(column)) - 1.0;
    if (column == 0) return vec4(0.159, -0.252, 0.030, -0.495);
    if (column == 1) return vec4(0.601, 0.353, -0.225, -0.551);
    if (column == 2) return vec4(-0.855, 0.076, 0.900, 0.748);
    if (column == 3) return vec4(0.435, 0.253, -0.529, -0.813);
    if (column == 4) return vec4(-0.258, 0.046, 0.809, -0.191);
    if (column == 5) return vec4(0.500, 0.217, -0.666, -0.816);
    if (column == 6) return vec4(-0.488, 0.778, -0.138, 0.477);
    return vec4(0.095, -0.446, 0.331, -0.108);
}

vec2 source_place_at(int i) { return vec2(places_x(i >> 2)[i & 3], places_y(i >> 2)[i & 3]); }

// Volumes of a triangle's edges ab, bc and ca at the middle, and with slopes along both half axes.
struct SourceEdges {
    vec3 middle, right, up;
    vec3 pixel_right, pixel_up;   // slopes as the receiver moves with its pixel; kSpreads alone reads them
};

const vec2 kPixelStep = vec2(0.7548776662, 0.5698402910);

// Returns where receivers of the column's places lie in the pixel's area, pixels from its middle: one each, spread as
// those of shadow/filters/area_spread.glsl.
vec4 pixel_places(int column, float stride) {
    return fract((vec4(0.0, 1.0, 2.0, 3.0) + 4.0 * float(column)) * stride + 0.5) - 0.5;
}

// Places beyond an edge: a bit each.
struct PlacesBelow { uint ab, bc, ca; };

uint four_bits(vec4 value) {
    return (value.x < 0.0 ? 1u : 0u) | (value.y < 0.0 ? 2u : 0u) | (value.z < 0.0 ? 4u : 0u) | (value.w < 0.0 ? 8u : 0u);
}

PlacesBelow with_column(PlacesBelow below, SourceEdges edges, int column) {
    vec4 x = places_x(column), y = places_y(column);
    vec4 ab = edges.middle.x + edges.right.x * x + edges.up.x * y, bc = edges.middle.y + edges.right.y * x + edges.up.y * y;
    vec4 ca = edges.middle.z + edges.right.z * x + edges.up.z * y;
    if (kSpreads) {
        vec4 pixel_x = pixel_places(column, kPixelStep.x), pixel_y = pixel_places(column, kPixelStep.y);
        ab += edges.pixel_right.x * pixel_x + edges.pixel_up.x * pixel_y;
        bc += edges.pixel_right.y * pixel_x + edges.pixel_up.y * pixel_y;
        ca += edges.pixel_right.z * pixel_x + edges.pixel_up.z * pixel_y;
    }
    PlacesBelow next;
    next.ab = below.ab | four_bits(ab) << (4 * column);
    next.bc = below.bc | four_bits(bc) << (4 * column);
    next.ca = below.ca | four_bits(ca) << (4 * column);
    return next;
}

PlacesBelow places_below(SourceEdges edges) {
    PlacesBelow below;
    below.ab = below.bc = below.ca = 0u;
    below = with_column(below, edges, 0);
    below = with_column(below, edges, 1);
    below = with_column(below, edges, 2);
    below = with_column(below, edges, 3);
    below = with_column(below, edges, 4);
    below = with_column(below, edges, 5);
    below = with_column(below, edges, 6);
    return with_column(below, edges, 7);
}

// Returns the places at which a linear value is below 0.
uint places_below_one(float middle, float right, float up) {
    uint below = 0u;
    int column = 0;
    do {
        below |= four_bits(middle + right * places_x(column) + up * places_y(column)) << (4 * column);
    } while (++column < 8);
    return below;
}

// Returns the places with receivers at which a value that is linear over the pixel is below 0.
uint receivers_below(float middle, float right, float up) {
    uint below = 0u;
    int column = 0;
    do {
        below |= four_bits(middle + right * pixel_places(column, kPixelStep.x) + up * pixel_places(column, kPixelStep.y)) << (4 * column);
    } while (++column < 8);
    return below;
}

// Returns the weights of a triangle's corners along the way to a place.
vec3 weights_toward(SourceEdges edges, int i) {
    vec2 at = source_place_at(i);
    vec3 inside = edges.middle + edges.right * at.x + edges.up * at.y;
    return vec3(inside.y, inside.z, inside.x) / (inside.x + inside.y + inside.z);
}

// Returns the share of the places above the receiver's plane that is seen.
float seen_share(SourcePlaces source) {
    int above = bitCount(source.above);
    return above > 0 ? float(bitCount(source.above & ~source.hidden)) / float(above) : 1.0;
}
