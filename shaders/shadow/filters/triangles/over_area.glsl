// Edges of the casters, antialiased: the share of a pixel's area on the receiver's plane that the light reaches. Where
// texels around the area agree, that is the answer. Elsewhere the triangles that they show darken places of it. Where
// no edge crosses the area, the answer is the one for its middle.
//
// A triangle darkens places only if the receiver lies behind its plane. So a crease within the area is no edge of a
// shadow. What lies beyond it on the receiver's plane is inside the other surface and does not show.

// Largest distance of a texel from the receiver. What the light grazes covers any number of texels.
const float kMostReach_texel = 16.0;
// Room for a curved mesh's bend as far from the receiver as the outer texels lie, in kOwnSurface_texel.
const float kFartherBend = 4.0;

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

int bits_of(bvec4 which) { return int(dot(vec4(which), vec4(1.0, 2.0, 4.0, 8.0))); }

OuterTexels outer_texels(ShadowPoint point, AreaPlaces area, vec2 place) {
    OuterTexels outer;
    vec2 reach = min(0.5 * (abs(texels_moved(point, area.right)) + abs(texels_moved(point, area.up))), vec2(kMostReach_texel));
    outer.low = floor(place - reach + 0.5);
    outer.high = floor(place + reach + 0.5);
    vec2 slopes = abs(point.slope);
    float own = kFartherBend * kOwnSurface_texel * (slopes.x + slopes.y);
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

#ifdef LEAVE_UNDECIDED
// true where texels do not agree, in the first draw of a light.
bool shadow_undecided = false;

float shadow_filter(ShadowPoint point) {
    AreaPlaces area = area_places(point.position_ca, point.normal, toward_light(point.position_ca));
    FourTexels four = four_texels(point);
    OuterTexels outer = outer_texels(point, area, four.place);
    bool lit = !(any(may_darken(point, four)) || outer.may != 0);
    shadow_undecided = shadow_undecided || !(lit || (four.all_dark && outer.all_dark));
    return lit ? 1.0 : 0.0;
}
#else
// Returns `bits` without those of triangles that `others` show where `other_bits` has a bit.
int without(FourTriangles shown, int bits, FourTriangles others, int other_bits) {
    for (int i = 0; i < 4; ++i) {
        bvec4 same = bvec4(ivec4(equal(others.triangle, uvec4(shown.triangle[i]))) * ivec4(equal(others.instance, uvec4(shown.instance[i]))) * (ivec4(other_bits) >> ivec4(0, 1, 2, 3) & 1));
        if (any(same)) bits &= ~(1 << i);
    }
    return bits;
}

// Returns `bits` without those of triangles that an earlier bit shows.
int without_repeats(FourTriangles shown, int bits) {
    for (int i = 1; i < 4; ++i)
        for (int j = 0; j < i; ++j)
            if ((bits >> j & 1) != 0 && shown.triangle[j] == shown.triangle[i] && shown.instance[j] == shown.instance[i]) bits &= ~(1 << i);
    return bits;
}

// Returns the bits of texels that may darken and show a triangle that no earlier one does. `inner`: bits of the four
// around the receiver.
int different_triangles(ShownTriangles shown, int inner, int outer) {
    int a = without(shown.a, outer & 15, shown.inner, inner);
    int b = without(shown.b, without(shown.b, outer >> 4 & 15, shown.inner, inner), shown.a, a);
    int c = without(shown.c, without(shown.c, without(shown.c, outer >> 8 & 15, shown.inner, inner), shown.a, a), shown.b, b);
    int d = without(shown.d, without(shown.d, without(shown.d, without(shown.d, outer >> 12 & 15, shown.inner, inner), shown.a, a), shown.b, b), shown.c, c);
    return inner | without_repeats(shown.a, a) << 4 | without_repeats(shown.b, b) << 8 | without_repeats(shown.c, c) << 12 | without_repeats(shown.d, d) << 16;
}

float shadow_filter(ShadowPoint point) {
    AreaPlaces area = area_places(point.position_ca, point.normal, toward_light(point.position_ca));
    FourTexels four = four_texels(point);
    OuterTexels outer = outer_texels(point, area, four.place);
    bvec4 may = may_darken(point, four);
    bool lit = !any(may);
    float error_m = error_along_view_m(point.position_ca, point.normal, point.error_m);
    bool agree = (lit && outer.may == 0) || (four.all_dark && outer.all_dark);
    if (!agree) {
        ShownTriangles shown = ShownTriangles(shadow_triangles_around(point, four.corner), shadow_triangles_around(point, outer_corner(outer, 0)),
                                              shadow_triangles_around(point, outer_corner(outer, 1)), shadow_triangles_around(point, outer_corner(outer, 2)),
                                              shadow_triangles_around(point, outer_corner(outer, 3)));
        int starts = different_triangles(shown, different(four, may, shown.inner), outer.may);
        int verdict = casters_verdict(shown, starts, point.position_ca, point.normal, error_m, shadow_texel_sides(point), area);
        // Where walks come to no end, the nearest texels decide.
        vec4 clear = vec4(point.reference + abs(point.slope.x) + abs(point.slope.y));
        bvec4 is_dark = greaterThan(four.stored, max(four.plane, clear));
        AreaQuarters quarters = AreaQuarters(four.place - four.corner, texels_moved(point, area.right), texels_moved(point, area.up));
        area.dark |= area.unknown ? places_in_quarters(quarters, is_dark) : 0u;
        if (!(lit || four.all_dark)) {
            lit = verdict != kBlocked;
            if (verdict == kUnknown) {
                vec2 nearest = floor(four.place) + 0.5;
                lit = lit_at(point, four.place, nearest, shadow_depth(point, nearest)) > 0.0;
            }
        }
    }
    float share = lit_places(area);
    return share > 0.0 && share < 1.0 ? share : (lit ? 1.0 : 0.0);
}
#endif
