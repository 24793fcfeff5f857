// Triangles between a receiver and a source with a size, which hide places of it. Texels around the receiver show some.
// Their neighbours in the mesh follow, as far as they may hide more.

// Most triangles of a pixel.
const int kMostTested = 24;
// Most triangles in a row that hide nothing, on the way to what may.
const int kMostAside = 4;

// Texels with triangles to test: a bit each for four around the receiver, then for taps of the search.
struct StartTexels {
    uint bits, sure;      // `sure`: those of casters that hide something
    vec2 place, corner;   // the receiver's, and the corner between the four
    SearchSpiral spiral;
    float before;         // mean distance before the receiver of casters in the cone, in depth
};

// Returns the middle of a start's texel. The four are in textureGather's order.
vec2 start_middle(StartTexels starts, int i) {
    if (i < 4) return starts.corner + vec2(i == 0 || i == 3 ? -0.5 : 0.5, i < 2 ? 0.5 : -0.5);
    return floor(starts.place + spiral_offset(starts.spiral, i - 4)) + 0.5;
}

// Returns the source with places hidden by triangles. The way goes over the edges that seen places lie beyond, or toward
// the source. Where a triangle faces the light the other way than the first, the mesh folds back. It counts; the way goes
// on beyond it only if it hides something.
// One loop takes all triangles, so that neighbouring pixels go in step.
SourcePlaces behind_triangles(ShadowPoint point, StartTexels starts, SourcePlaces source) {
    float error_m = error_along_view_m(point.position_ca, point.normal, point.error_m);
    vec2 texel = shadow_texel_sides(point);
    PixelArea area = receiver_area(point);
    uint left = starts.bits;
    uvec2 at = uvec2(0u, kNothing);   // instance, triangle
    Visited visited = none_visited();
    uvec4 waiting = kNoTriangles;   // neighbours, of the same instance
    int steps = 0, aside = 0;
    float first_faces = 0.0;
    if (left != 0u) do {
        // The next start that was not visited.
        if (at.y == kNothing && left != 0u) do {
            int i = findLSB((left & starts.sure) != 0u ? left & starts.sure : left);
            left &= ~(1u << i);
            at = shadow_triangle_at(point, start_middle(starts, i));
            if (is_among(at, visited)) at.y = kNothing;
        } while (at.y == kNothing && left != 0u);
        visited = with(visited, at);
        bool known = at.y != kNoTriangle && at.y != kNothing;
        InstanceRecord instance = instance_record(at.x);
        CasterTriangle t = caster_triangle(known ? at.y : 0u);
        SeenCorners corners = corners_from(point.position_ca, instance, t);
        vec3 a_ca = corners.a_ca, a = corners.a, b = corners.b, c = corners.c;
        vec3 ab = b - a, ac = c - a;
        vec3 normal = cross(ab, ac);
        vec3 sides = max(vec3(length(ab), length(c - b), length(ac)), vec3(kLeastSide_m));
        float faces = dot(normal, toward_light(a_ca));
        first_faces = first_faces == 0.0 ? faces : first_faces;
        // Which side the receiver sees: it stays so for all places that the triangle hides.
        float off = dot(normal, a), side = off < 0.0 ? -1.0 : 1.0;
        float rounding = error_m * length(normal) + kPlaneRounding * sides.x * sides.z * length(a);
        bool darkens = known && abs(off) > rounding;
        mat3 beside = mat3(side * cross(a, b), side * cross(b, c), side * cross(c, a));
        SourceEdges edges;
        edges.middle = source.middle * beside;
        edges.right = source.right * beside;
        edges.up = source.up * beside;
        float lamp = kIsSun ? 0.0 : 1.0;
        mat3 along = mat3(side * ab, side * (c - b), -side * ac);
        edges.pixel_right = cross(area.right, source.middle) * along - lamp * (area.right * beside);
        edges.pixel_up = cross(area.up, source.middle) * along - lamp * (area.up * beside);
        vec3 reach = kOnSquare ? abs(edges.right) + abs(edges.up) : sqrt(edges.right * edges.right + edges.up * edges.up);
        vec3 most = edges.middle + reach;
        if (kSpreads) most += 0.5 * (abs(edges.pixel_right) + abs(edges.pixel_up));
        bool overlaps = darkens && min(most.x, min(most.y, most.z)) >= 0.0;
        bool masked = kHasMasks && t.across_ab == kMaskedTriangle;
        // A loop, since software devices run what is in an `if` for every pixel.
        PlacesBelow below;
        below.ab = below.bc = below.ca = kAllPlaces;
        for (int once = overlaps ? 1 : 0; once > 0; --once) below = places_below(edges);
        uint inside = ~(below.ab | below.bc | below.ca);
        // Where a lamp's source reaches through the triangle's plane, places before it are not hidden.
        vec3 through = vec3(dot(edges.middle, vec3(1.0)) - abs(off), dot(edges.right, vec3(1.0)), dot(edges.up, vec3(1.0)));
        bool reaches = !kIsSun && inside != 0u && through.x < abs(through.y) + abs(through.z);
        for (int once = reaches ? 1 : 0; once > 0; --once) inside &= ~places_below_one(through.x, through.y, through.z);
        // What is beyond the triangle's plane is before it: beyond an edge of the receiver's own surface.
        vec2 nearer = side * vec2(dot(normal, area.right), dot(normal, area.up));
        bool crosses = kSpreads && inside != 0u && abs(off) - rounding < 0.5 * (abs(nearer.x) + abs(nearer.y));
        for (int once = crosses ? 1 : 0; once > 0; --once) inside &= ~receivers_below(abs(off) - rounding, -nearer.x, -nearer.y);
        if (!masked) source.hidden |= inside;
        if (kHasMasks) {
            vec3 to_light = toward_light(a_ca);
            float area_m2 = abs(dot(normal, source.middle)) / length(source.middle);
            bool resolved = masked && is_resolved(t.across_bc, t.across_ca, area_m2, texel_area_m2(texel, to_light));
            source.unknown = source.unknown || (masked && !resolved);
            uint by_mask = resolved ? inside & ~source.hidden : 0u;
            for (; by_mask != 0u; by_mask &= by_mask - 1u)
                if (is_there(t.across_bc, t.across_ca, weights_toward(edges, findLSB(by_mask)))) source.hidden |= by_mask & (0u - by_mask);
        }
        uint seen = source.above & ~source.hidden;
        bool goes = known && darkens && !masked && (!(first_faces * faces < 0.0) || inside != 0u) && (overlaps || aside < kMostAside);
        bool over_ab = goes && is_new_beyond(at, t.across_ab, visited), over_bc = goes && is_new_beyond(at, t.across_bc, visited);
        bool over_ca = goes && is_new_beyond(at, t.across_ca, visited);
        vec3 ways = most / sides;
        const float kShut = 3.0e38;
        ways = vec3(over_ab ? ways.x : kShut, over_bc ? ways.y : kShut, over_ca ? ways.z : kShut);
        float way = min(ways.x, min(ways.y, ways.z));
        over_ab = over_ab && (overlaps ? (below.ab & ~(below.bc | below.ca) & seen) != 0u : ways.x == way);
        over_bc = over_bc && (overlaps ? (below.bc & ~(below.ab | below.ca) & seen) != 0u : ways.y == way);
        over_ca = over_ca && (overlaps ? (below.ca & ~(below.ab | below.bc) & seen) != 0u : ways.z == way);
        if (over_ab) waiting = uvec4(t.across_ab, waiting.x, waiting.y, waiting.z);
        if (over_bc) waiting = uvec4(t.across_bc, waiting.x, waiting.y, waiting.z);
        if (over_ca) waiting = uvec4(t.across_ca, waiting.x, waiting.y, waiting.z);
        source.unknown = source.unknown || at.y == kNoTriangle;
        ++steps;
        bool waits = waiting.x != kNoTriangle;
        aside = waits && !overlaps ? aside + 1 : 0;
        first_faces = waits ? first_faces : 0.0;
        at = waits ? uvec2(at.x, waiting.x) : uvec2(0u, kNothing);
        waiting = uvec4(waiting.y, waiting.z, waiting.w, kNoTriangle);
    } while ((at.y != kNothing || left != 0u) && steps < kMostTested && (source.above & ~source.hidden) != 0u);
    bool more = at.y != kNothing || left != 0u;
    source.unknown = source.unknown || (more && (source.above & ~source.hidden) != 0u);
    return source;
}
