// Edges of the casters, antialiased: the share of a pixel's area on the receiver's plane that the light reaches. Where
// texels around the area agree, that is the answer. Elsewhere the triangles that they show darken places of it.
//
// A triangle darkens places only if the receiver lies behind its plane. So a crease within the area is no edge of a
// shadow. What lies beyond it on the receiver's plane is inside the other surface and does not show.

// Largest distance of a texel from the receiver. What the light grazes covers any number of texels.
const float kMostReach_texel = 16.0;
// Longest side of an area that blocks of texels at its corners show.
const float kSeenByBlocks_texel = 3.0;

// Blocks of four texels at the corners of the smallest rectangle of texels' middles around an area, in textureGather's
// order. A straight edge that crosses the area parts them.
struct OuterTexels {
    vec2 low, high;   // corners between the texels of the first block, and of the last
    int may;          // bits: may show what darkens the area
    bool all_dark;
};

vec2 outer_corner(OuterTexels outer, int i) {
    return vec2(i == 1 || i == 2 ? outer.high.x : outer.low.x, i < 2 ? outer.high.y : outer.low.y);
}

OuterTexels outer_texels(ShadowPoint point, AreaPlaces area, vec2 place) {
    OuterTexels outer;
    vec2 reach = min(0.5 * (abs(texels_moved(point, area.right)) + abs(texels_moved(point, area.up))), vec2(kMostReach_texel));
    outer.low = floor(place - reach + 0.5);
    outer.high = floor(place + reach + 0.5);
    vec2 slopes = abs(point.slope);
    float own = kOwnSurface_texel * (slopes.x + slopes.y);
    float clear = point.reference + dot(slopes, max(outer.high - place, place - outer.low) + 0.5);
    outer.may = 0;
    outer.all_dark = true;
    for (int i = 0; i < 4; ++i) {
        vec2 corner = outer_corner(outer, i);
        vec4 stored = shadow_depths(point, corner);
        vec2 low = point.slope * (corner - 0.5 - place), high = low + point.slope;
        vec4 plane = point.reference + vec4(low.x, high.x, high.x, low.x) + vec4(high.y, high.y, low.y, low.y);
        vec4 above = stored - plane;
        vec4 darkens = vec4(greaterThan(above, vec4(own))) + vec4(lessThan(above, vec4(-own))) * vec4(greaterThan(stored, vec4(point.reference)));
        outer.may |= bits_of(greaterThan(darkens, vec4(0.0))) << 4 * i;
        outer.all_dark = outer.all_dark && all(greaterThan(stored, max(plane, vec4(clear))));
    }
    return outer;
}

// Places by the texels above them: bits of places with a texel that may show what darkens them, or does so beyond doubt.
struct DarkTexels { uint may, are; };

DarkTexels dark_texels(ShadowPoint point, AreaPlaces area, vec2 place, bool wanted) {
    vec2 right = texels_moved(point, area.right), up = texels_moved(point, area.up), slopes = abs(point.slope);
    float own = kOwnSurface_texel * (slopes.x + slopes.y);
    DarkTexels dark = DarkTexels(0u, 0u);
    int i = 0;
    if (wanted) do {
        vec2 at = place_in_area(i), middle = floor(place + right * at.x + up * at.y) + 0.5;
        float stored = shadow_depth(point, middle), above = stored - (point.reference + dot(point.slope, middle - place));
        bool may = above > own || (above < -own && stored > point.reference);
        bool is = above > 0.0 && stored > point.reference + dot(slopes, abs(middle - place) + 0.5);
        dark.may |= may ? 1u << i : 0u;
        dark.are |= is ? 1u << i : 0u;
    } while (++i < kPlaceCount);
    return dark;
}

// Returns whether blocks at the corners miss texels of an area.
bool has_other_texels(ShadowPoint point, AreaPlaces area) {
    vec2 sides = abs(texels_moved(point, area.right)) + abs(texels_moved(point, area.up));
    return max(sides.x, sides.y) > kSeenByBlocks_texel;
}

// Returns the share of the area that is lit.
float area_share(ShadowPoint point) {
    AreaPlaces area = area_places(point.position_ca, point.normal, toward_light(point.position_ca));
    FourTexels four = four_texels(point);
    OuterTexels outer = outer_texels(point, area, four.place);
    bvec4 may = may_darken(point, four);
    bool more = has_other_texels(point, area);
    DarkTexels dark = dark_texels(point, area, four.place, more);
    if (!any(may) && outer.may == 0 && dark.may == 0u) return 1.0;
    if (four.all_dark && outer.all_dark && (!more || dark.may == kAllPlaces)) return 0.0;
    ShownTriangles shown = ShownTriangles(shadow_triangles_around(point, four.corner), shadow_triangles_around(point, outer_corner(outer, 0)),
                                          shadow_triangles_around(point, outer_corner(outer, 1)), shadow_triangles_around(point, outer_corner(outer, 2)),
                                          shadow_triangles_around(point, outer_corner(outer, 3)));
    int starts = bits_of(may) & bits_of(greaterThan(four.stored, vec4(0.0))) | outer.may << 4;
    darken_places(point, AreaStarts(shown, starts, four.place, dark.may), area);
    // Where triangles are too fine, the nearest texels decide.
    area.dark |= dark_texels(point, area, four.place, area.unknown).are;
    return lit_places(area);
}
