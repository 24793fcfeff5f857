// Tint of a light by rays: the share of the light that passes through all translucent triangles between it and a place,
// per channel. Absorbances add up in whole steps, so that the order of the walk changes no bit.
#include "common/camera_block.glsl"
#include "common/float_rounding.glsl"
#include "shadow/lookup/row_flags.glsl"
#include "shadow/lookup/light_block.glsl"
#include "shadow/lookup/light_vector.glsl"
#include "shadow/passes/tint/absorbance.glsl"
#include "shadow/lookup/tint/tint_tree.glsl"
#include "ray_tracing/ray_box.glsl"
const bool kTinted = true;

// Returns the side of an edge on which the ray passes, antisymmetric in p and q to the last bit: see
// ray_tracing/ray_triangle_f64.glsl.
float tint_side(vec3 along, vec3 p, vec3 q) {
    precise vec3 edge = q - p, sum = p + q;
    precise float x = edge.y * sum.z - edge.z * sum.y;
    precise float y = edge.z * sum.x - edge.x * sum.z;
    precise float z = edge.x * sum.y - edge.y * sum.x;
    precise float side = along.x * x + along.y * y + along.z * z;
    return side;
}

// Returns whether a side that the ray meets exactly belongs to a triangle that turns that way about it. One
// of two triangles with a common edge owns it, so that the ray counts one of them.
bool owns_side(vec3 p, vec3 q, bool turns) {
    bool rises = p.x != q.x ? p.x < q.x : (p.y != q.y ? p.y < q.y : p.z < q.z);
    return rises == turns;
}

// Returns the absorbance of a triangle for a ray from the anchor's side: 0 if the ray misses it, in whole steps.
// `off_m`: how far the ray's beginning may be off its surface. A triangle with that place in its plane is that surface.
uvec3 absorbed_by(uint at, vec3 from, vec3 along, float last, float off_m) {
    vec3 a = tint_vec3(at) - from, b = tint_vec3(at + 3u) - from, c = tint_vec3(at + 6u) - from;
    vec3 sides = vec3(tint_side(along, b, c), tint_side(along, c, a), tint_side(along, a, b));
    bool inside = all(greaterThanEqual(sides, vec3(0.0))) || all(lessThanEqual(sides, vec3(0.0)));
    float sum = sides.x + sides.y + sides.z;
    vec3 normal = cross(b - a, c - a);
    float slope = dot(normal, along), height = dot(normal, a);
    if (!inside || sum == 0.0 || slope == 0.0) return uvec3(0u);
    bool ahead = (slope > 0.0 ? height : -height) > off_m * length(normal);
    bool before_end = last >= kNoEnd || (slope > 0.0 ? height < last * slope : height > last * slope);
    bool turns = slope > 0.0;
    bool owned = (sides.x != 0.0 || owns_side(b, c, turns)) && (sides.y != 0.0 || owns_side(c, a, turns)) &&
                 (sides.z != 0.0 || owns_side(a, b, turns));
    if (!ahead || !before_end || !owned) return uvec3(0u);
    return uvec3(absorbance_of(tint_of_triangle(at, sides / sum)) * kSteps + 0.5);
}

// Returns what passes along one way to the light, from a place relative to the tree's anchor.
vec3 passed_along(TintHead head, vec3 from, vec3 along, float rounded_m, float off_m) {
    float last = kIsSun ? kNoEnd : 1.0;
    BoxRay boxes = box_ray(from, along, kBoxUnits * kUnitRoundoff * rounded_m);
    uint layers = uint(light.to_light.w + 0.5);
    uvec3 absorbed = uvec3(0u);
    uint n = 0u;
    while (n < head.nodes) {
        TintNode node = tint_node(n);
        bool met = meets_box(boxes, node.low, node.high, last);
        uint first = node.leaf >> 4u, slots = met ? node.leaf & 15u : 0u;
        for (uint i = 0u; i < slots; ++i) {
            uint at = head.triangles + (first + i) * kTintTriangleWords;
            if ((tint_words[at + 9u] & layers) != 0u) absorbed += absorbed_by(at, from, along, last, off_m);
        }
        n = met ? n + 1u : node.skip;
    }
    return transmittance_of(vec3(absorbed) / kSteps);
}

// Returns two axes across a unit vector (Duff et al. 2017, "Building an orthonormal basis, revisited").
mat2x3 axes_across(vec3 z) {
    float side = z.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (side + z.z), b = z.x * z.y * a;
    return mat2x3(vec3(1.0 + side * z.x * z.x * a, side * b, -side * z.x), vec3(b, side + z.y * z.y * a, -z.y));
}

// Returns the mean over places of a source with a size: a disk that faces the receiver, in a spiral of equal areas
// (Vogel 1979).
vec3 passed_from_source(TintHead head, vec3 from, vec3 along, float rounded_m, float off_m) {
    const int kPlaces = 32;
    const float kGoldenAngle_rad = 2.39996323;
    mat2x3 axes = axes_across(normalize(along));
    vec3 passed = vec3(0.0);
    for (int i = 0; i < kPlaces; ++i) {
        float radius = light.radiance.w * sqrt((float(i) + 0.5) / float(kPlaces)), angle = float(i) * kGoldenAngle_rad;
        passed += passed_along(head, from, along + axes * (radius * vec2(cos(angle), sin(angle))), rounded_m, off_m);
    }
    return passed / float(kPlaces);
}

vec3 shadow_tint(vec3 position_ca, vec3 normal, float error_m) {
    TintHead head = tint_head();
    vec3 along = toward_light(position_ca);
    precise vec3 from = position_ca + ((camera.anchor_high.xyz - head.anchor_high) + (camera.anchor_low.xyz - head.anchor_low));
    vec3 sizes = abs(from) + abs(position_ca) + head.reach_m;
    float rounded_m = max(sizes.x, max(sizes.y, sizes.z));
    float off_m = error_m + kPositionRounding * rounded_m;
    if (light.radiance.w > 0.0) return passed_from_source(head, from, along, rounded_m, off_m);
    return passed_along(head, from, along, rounded_m, off_m);
}
