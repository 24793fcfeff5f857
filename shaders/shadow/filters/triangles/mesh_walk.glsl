// Search for a triangle between a receiver and its light, among the triangles that texels show and their neighbours in
// the mesh. The casters' own corners decide: no texel's size enters. RAY_MASKS names the file that reads their masks.
#include "common/float_rounding.glsl"
#include "common/instances.glsl"
#include "common/view_vector.glsl"
#include "shadow/filters/triangles/triangle_buffer.glsl"
#include "shadow/lookup/light_vector.glsl"
#include RAY_MASKS

const uint kNoTriangle = 0xffffffffu, kMaskedTriangle = 0xfffffffeu;
const uint kNowhere = 0xfffffffdu;   // the triangle before the first of a walk
const int kPasses = 0, kBlocked = 1, kUnknown = 2;
// Most steps of a walk, and from its second fold on. A texel's triangle and the one above the receiver are neighbours,
// or few apart. Meshes finer than texels are voted on. Half as many again beyond the first fold.
const int kMostSteps = 16, kMostStepsBeyond = 8;
// Most folds of a walk. Where a sheet ends its mesh goes on: a ledge has an underside, and below that stands the next
// ledge, narrower perhaps than a texel. Two ledges, one below the other, are four folds.
const int kMostFolds = 4;
const float kLeastSide_m = 1e-30;   // bounds divisors: a triangle may have all corners in one place
// Rounding of a difference, a cross product and a dot product, with their sums.
const float kPlaneRounding = 12.0 * kUnitRoundoff;

vec3 corner_ca(InstanceRecord instance, vec3 position_ms) {
    return position_from_anchor(instance, position_ms, camera.anchor_high.xyz, camera.anchor_low.xyz);
}

// Corners of a triangle as seen from a place. a_ca: the first one, relative to the anchor.
struct SeenCorners {
    vec3 a_ca, a, b, c;
};

SeenCorners corners_from(vec3 position_ca, InstanceRecord instance, CasterTriangle t) {
    SeenCorners corners;
    corners.a_ca = corner_ca(instance, t.a);
    corners.a = corners.a_ca - position_ca;
    corners.b = corner_ca(instance, t.b) - position_ca;
    corners.c = corner_ca(instance, t.c) - position_ca;
    return corners;
}

// Returns how far off a place may be along the view, metres. A place is rebuilt along the view. Where its surface is
// seen aslant, it is farther off in that direction than error_m, and thus from the planes of others. Beside a crease it
// may lie behind what it meets there.
float error_along_view_m(vec3 position_ca, vec3 normal, float error_m) {
    return error_m / max(abs(dot(normal, normalize(to_camera(position_ca)))), kNormalError_rad);
}

// Returns whether a triangle shows area to the light, beyond rounding. What a node flattens shows none, nor what the
// light passes along. `faces`: normal times the vector to the light. Below the bound its sign is random.
bool shows_area(float faces, vec3 normal, vec3 sides, vec3 a, vec3 to_light) {
    float rounding_m2 = kPlaneRounding * (max(sides.x, max(sides.y, sides.z)) * length(a) + length(normal));
    return abs(faces) > rounding_m2 * length(to_light);
}

// Returns the verdict on a masked triangle before the receiver. It has no sheet to walk: what lies beside it shows in
// other texels.
int masked_verdict(CasterTriangle t, vec3 inside, float area_m2, float texel_m2) {
    if (!is_resolved(t.across_bc, t.across_ca, area_m2, texel_m2)) return kUnknown;
    if (min(inside.x, min(inside.y, inside.z)) < 0.0) return kPasses;
    vec3 weights = vec3(inside.y, inside.z, inside.x) / (inside.x + inside.y + inside.z);
    return is_there(t.across_bc, t.across_ca, weights) ? kBlocked : kPasses;
}

// Returns the triangle of the lowest bit, out of four that texels show.
uvec2 shown_at(FourTriangles shown, int bits) {
    int i = (bits & 1) != 0 ? 0 : ((bits & 2) != 0 ? 1 : ((bits & 4) != 0 ? 2 : 3));
    return uvec2(shown.instance[i], shown.triangle[i]);
}

// Returns the verdict on the triangles of `shown` with bits in `left`, one after the other.
// A walk starts at the triangle that a texel shows and goes through the mesh toward the receiver's ray. Where a
// triangle faces the light the other way, the surface folds back, away from the ray. The walk then goes on over the
// edge nearest to the ray, a few folds far, since what comes next may turn toward it again. At a boundary the mesh is
// over, and the ray passes it.
// Where the ray meets a triangle, it is blocked if the receiver lies behind that plane and no mask cuts it out there.
// It lies behind by more than rounding, or by what the camera sees of it. A walk may take any way: a triangle that it
// finds always stands between receiver and light.
// `texel`: sides of the map's texel, metres, or tangents from a lamp. kUnknown: some walk came to no end before any
// fold, and none was blocked.
// One loop takes all steps of all walks. Neighbouring pixels go in step: no walk stands still until another's ends.
int casters_verdict(FourTriangles shown, int left, vec3 position_ca, vec3 receiver_normal, float error_m, vec2 texel) {
    vec3 ray = toward_light(position_ca), view = to_camera(position_ca);
    // True: the receiver faces the camera. Only then the side of a triangle that the camera sees is the receiver's.
    bool shows = dot(receiver_normal, view) > 0.0;
    bool blocked = false, unknown = false;
    uvec2 at = shown_at(shown, left);   // instance, triangle
    uint came_from = kNowhere;
    bool toward = true;   // over an edge beyond which the ray passes
    float facing = 0.0;
    int steps = 0, folds = 0;
    if (left != 0) do {
        InstanceRecord instance = instance_record(at.x);
        CasterTriangle t = caster_triangle(at.y == kNoTriangle ? 0u : at.y);
        SeenCorners corners = corners_from(position_ca, instance, t);
        vec3 a_ca = corners.a_ca, a = corners.a, b = corners.b, c = corners.c;
        vec3 ab = b - a, ac = c - a;
        vec3 normal = cross(ab, ac);
        vec3 to_light = toward_light(a_ca);
        vec3 sides = max(vec3(length(ab), length(c - b), length(ac)), vec3(kLeastSide_m));
        // Without area it faces nowhere: the walk crosses it as it came.
        float faces = dot(normal, to_light);
        bool has_area = shows_area(faces, normal, sides, a, to_light);
        faces = has_area ? faces : facing;
        float side = faces < 0.0 ? -1.0 : 1.0;
        // Above 0: the ray passes on the inner side of the edge.
        vec3 beside_ab = cross(a, b), beside_bc = cross(b, c), beside_ca = cross(c, a);
        vec3 inside = side * vec3(dot(ray, beside_ab), dot(ray, beside_bc), dot(ray, beside_ca));
        uvec3 across = uvec3(t.across_ab, t.across_bc, t.across_ca);
        vec3 ways = inside / sides;   // distance beside each edge, in lengths of `ray`
        const float kBack = 3.0e38;
        ways = vec3(across.x == came_from ? kBack : ways.x, across.y == came_from ? kBack : ways.y, across.z == came_from ? kBack : ways.z);
        float way = min(ways.x, min(ways.y, ways.z));
        uint next = ways.x == way ? across.x : (ways.y == way ? across.y : across.z);
        bool turns = facing * faces < 0.0;
        folds += turns ? 1 : 0;
        // The edge that the walk came over does not decide again, where the ray passes beyond it: rounding might decide
        // otherwise.
        bool met = has_area && way >= 0.0 && ((toward && !turns) || min(inside.x, min(inside.y, inside.z)) >= 0.0);
        float behind = side * dot(normal, a);
        float rounding = error_m * length(normal) + kPlaneRounding * sides.x * sides.z * length(a);
        steps = turns && folds == 1 ? 1 : steps + 1;
        int verdict = kUnknown;
        // A receiver behind the plane by less than rounding lies behind it if the camera sees that side, since the
        // receiver shows. The exception is a triangle that lies wholly below the receiver's own plane, as what a
        // silhouette hides.
        bool averted = shows && faces * dot(normal, view) < 0.0;
        float above = max(dot(receiver_normal, a), max(dot(receiver_normal, b), dot(receiver_normal, c)));
        bool darkens = behind > rounding || (behind > 0.0 && averted && above > error_m);
        if (folds > kMostFolds) verdict = kPasses;
        else if (met) verdict = darkens ? kBlocked : kPasses;
        else if (next == kNoTriangle || (steps == kMostStepsBeyond && folds > 0)) verdict = kPasses;
        bool ends = verdict != kUnknown || at.y == kNoTriangle || steps == kMostSteps;
        if (kHasMasks && t.across_ab == kMaskedTriangle) {
            verdict = behind > rounding ? masked_verdict(t, inside, abs(dot(normal, ray)) / length(ray), texel_area_m2(texel, to_light)) : kPasses;
            ends = true;
        }
        if (at.y == kNoTriangle) verdict = kUnknown;
        blocked = verdict == kBlocked;
        unknown = unknown || (ends && verdict == kUnknown);
        came_from = ends ? kNowhere : at.y;
        toward = ends || way < 0.0;
        facing = ends ? 0.0 : faces;
        steps = ends ? 0 : steps;
        folds = ends ? 0 : folds;
        left = ends ? left & (left - 1) : left;
        at = ends ? shown_at(shown, left) : uvec2(at.x, next);
    } while (left != 0 && !blocked);
    return blocked ? kBlocked : (unknown ? kUnknown : kPasses);
}
