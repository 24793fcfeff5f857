// Quad over every texel that a triangle may overlap. A triangle that reaches behind the light gets the whole map, and
// its fragments decide. Edges as planes through the eye need no clipping (Olano and Greer 1997).
#include "shadow/passes/bounds/bounds_item.glsl"
flat out vec4 edge_ab, edge_bc, edge_ca;   // xyz: at least -w where (x, y, 1) lies on the inner side; of device
                                           // coordinates
flat out vec4 depth_plane;                 // xyz: depth at (x, y, 1); w: how far off that may be
flat out vec4 inverse_w;                   // the same of 1 / w
flat out vec4 box_texel;
flat out vec4 errors;                      // x: of x and y; y: of z; z: of w. w: departure per half texel, both axes
flat out float nearest;                    // depth of the nearest corner

const vec3 kAlong = vec3(1.0);

// Returns a bound on the components of a cross product, out of the vectors' absolute values.
vec3 crossed(vec3 a, vec3 b) { return a.yzx * b.zxy + a.zxy * b.yzx; }

// Returns how far a cross product may be off, each vector by its error. det_error() does so of a determinant.
vec3 cross_error(vec3 a, vec3 ea, vec3 b, vec3 eb) {
    vec3 most = crossed(a + ea, b + eb);
    return most - crossed(a, b) + kRoundings * 8.0 * kUnitRoundoff * most;
}
float det_error(vec3 a, vec3 ea, vec3 b, vec3 eb, vec3 c, vec3 ec) {
    float most = dot(a + ea, crossed(b + eb, c + ec));
    return most - dot(a, crossed(b, c)) + kRoundings * 16.0 * kUnitRoundoff * most;
}

struct Rows {
    vec4 a, ab, ac;      // in clip space: a corner, and the others from there
    vec4 ea, eab, eac;
};

float det_of(Rows r, int i, int j, int k) {
    vec3 a = vec3(r.a[i], r.a[j], r.a[k]), b = vec3(r.ab[i], r.ab[j], r.ab[k]), c = vec3(r.ac[i], r.ac[j], r.ac[k]);
    return dot(a, cross(b, c));
}
float det_error_of(Rows r, int i, int j, int k) {
    return det_error(abs(vec3(r.a[i], r.a[j], r.a[k])), vec3(r.ea[i], r.ea[j], r.ea[k]), abs(vec3(r.ab[i], r.ab[j], r.ab[k])),
                     vec3(r.eab[i], r.eab[j], r.eab[k]), abs(vec3(r.ac[i], r.ac[j], r.ac[k])), vec3(r.eac[i], r.eac[j], r.eac[k]));
}

vec4 edge_of(Corner from, vec3 along, vec3 along_error, float side) {
    vec3 inner = side * cross(from.place.xyw, along);
    vec3 error = cross_error(abs(from.place.xyw), from.error.xyw, abs(along), along_error);
    return vec4(inner, error.x + error.y + error.z);
}

bool is_outside(Corner a, Corner b, Corner c) {
    float beyond = 1.0 + 4.0 / map_size();
    vec4 error = max(a.error, max(b.error, c.error));
    vec2 slack = error.xy + beyond * error.w;
    vec3 w = beyond * vec3(a.place.w, b.place.w, c.place.w);
    vec3 x = vec3(a.place.x, b.place.x, c.place.x), y = vec3(a.place.y, b.place.y, c.place.y);
    bool behind = all(lessThanEqual(w, vec3(-beyond * error.w)));
    return behind || all(greaterThan(x - w, vec3(slack.x))) || all(greaterThan(-x - w, vec3(slack.x))) ||
           all(greaterThan(y - w, vec3(slack.y))) || all(greaterThan(-y - w, vec3(slack.y)));
}

// Returns a corner of the smaller box: along the map's axes, or along the longest side.
vec4 covering(Corner a, Corner b, Corner c, vec2 corner) {
    float size = map_size();
    box_texel = vec4(vec2(-size), vec2(2.0 * size));
    if (!is_before_light(a) || !is_before_light(b) || !is_before_light(c)) return box_at(vec2(0.0), vec2(size), corner);
    vec2 p = in_texels(a.place), q = in_texels(b.place), r = in_texels(c.place);
    vec2 low = min(p, min(q, r)), high = max(p, max(q, r));
    float most = max(max(abs(low.x), abs(low.y)), max(abs(high.x), abs(high.y)));
    float moved = max(moved_texel(a.place, a.error), max(moved_texel(b.place, b.error), moved_texel(c.place, c.error)));
    float reach = moved + kRoundings * 4.0 * kUnitRoundoff * most;
    box_texel = vec4(low - (kTexelHalf + reach), high + (kTexelHalf + reach));
    const float kBoxSlack = 0.014, kSlantedSlack = 0.02;   // by which a quad is larger than needed: it is snapped, too
    vec2 from = clamp(box_texel.xy - kBoxSlack, 0.0, size), to = clamp(box_texel.zw + kBoxSlack, 0.0, size);
    if (any(greaterThanEqual(from, to))) return nowhere();
    if (kAsPoints) return box_at(from, to, corner);
    vec2 side = q - p;
    if (dot(r - q, r - q) > dot(side, side)) side = r - q;
    if (dot(p - r, p - r) > dot(side, side)) side = p - r;
    float length_texel = length(side);
    if (most < 4.0 * size && length_texel > 1.0) {
        vec2 along = side / length_texel, across = vec2(-along.y, along.x);
        vec3 u = vec3(dot(p, along), dot(q, along), dot(r, along)), v = vec3(dot(p, across), dot(q, across), dot(r, across));
        float pad = 1.4142136 * kTexelHalf + kSlantedSlack + reach;
        vec2 least = vec2(min(u.x, min(u.y, u.z)), min(v.x, min(v.y, v.z))) - pad;
        vec2 last = vec2(max(u.x, max(u.y, u.z)), max(v.x, max(v.y, v.z))) + pad;
        vec2 slanted = last - least, straight = to - from;
        if (slanted.x * slanted.y < straight.x * straight.y) {
            vec2 at = mix(least, last, corner * 0.5 + 0.5);
            return at_texel(along * at.x + across * at.y);
        }
    }
    return box_at(from, to, corner);
}

void main() {
    BoundsItem item = bounds_item(gl_VertexID / kVertices);
    InstanceRecord instance = instance_record(item.instance);
    Corner a = corner_of(instance, item.a), b = corner_of(instance, item.b), c = corner_of(instance, item.c);
    gl_Position = nowhere();
    edge_ab = edge_bc = edge_ca = depth_plane = inverse_w = box_texel = errors = vec4(0.0);
    nearest = 0.0;
    if (kAsPoints) gl_PointSize = 1.0;
    if (is_outside(a, b, c)) return;
    gl_Position = covering(a, b, c, quad_corner(gl_VertexID));
    vec4 error = max(a.error, max(b.error, c.error));
    errors = vec4(max(error.x, error.y), error.z, error.w, kUnknownDeparture);
    // Depths before the near plane count as on it.
    nearest = 2.0;
    if (is_before_light(a) && is_before_light(b) && is_before_light(c)) {
        vec3 depth = vec3(a.place.z / a.place.w, b.place.z / b.place.w, c.place.z / c.place.w);
        vec3 off = vec3(a.error.z + abs(depth.x) * a.error.w, b.error.z + abs(depth.y) * b.error.w, c.error.z + abs(depth.z) * c.error.w);
        depth += off / vec3(a.place.w, b.place.w, c.place.w);
        nearest = max(depth.x, max(depth.y, depth.z));
    }
    Rows rows;
    rows.a = a.place;
    rows.ab = b.place - a.place;
    rows.ac = c.place - a.place;
    rows.ea = a.error;
    rows.eab = a.error + b.error + kRoundings * kUnitRoundoff * abs(rows.ab);
    rows.eac = a.error + c.error + kRoundings * kUnitRoundoff * abs(rows.ac);
    float det = det_of(rows, 0, 1, 3), off = det_error_of(rows, 0, 1, 3);
    float least = abs(det) - off;
    float side = det < 0.0 ? -1.0 : 1.0;
    edge_ab = edge_of(a, rows.ab.xyw, rows.eab.xyw, side);
    edge_bc = edge_of(b, (c.place - b.place).xyw, (b.error + c.error).xyw, side);
    edge_ca = edge_of(c, -rows.ac.xyw, rows.eac.xyw, side);
    if (least <= 0.5 * abs(det)) return;   // which way round it lies is not known, nor its slope
    // z = x A + y B + w C over the plane, by Cramer's rule.
    vec3 dets = vec3(det_of(rows, 2, 1, 3), det_of(rows, 0, 2, 3), det_of(rows, 0, 1, 2));
    vec3 offs = vec3(det_error_of(rows, 2, 1, 3), det_error_of(rows, 0, 2, 3), det_error_of(rows, 0, 1, 2));
    vec3 most = (abs(dets) + offs) / least;
    errors.w = (most.x + most.y) / map_size();
    depth_plane = vec4(dets / det, dot(offs + abs(dets / det) * off, kAlong) / least);
    vec3 normal = cross(rows.ab.xyw, rows.ac.xyw);
    vec3 normal_off = cross_error(abs(rows.ab.xyw), rows.eab.xyw, abs(rows.ac.xyw), rows.eac.xyw) + abs(normal / det) * off;
    inverse_w = vec4(normal / det, (dot(normal_off, kAlong) + (abs(normal.x) + abs(normal.y)) / map_size()) / least);
}
