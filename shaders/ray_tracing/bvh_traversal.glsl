// Search for any caster in a shadow ray's way, through the tree of instances and those of their meshes. Requires
// CameraBlock. RAY_MASKS names the file that reads the casters' masks.
// Floats decide wherever their error bound allows it. The few triangles that they leave open are noted, and decided in
// double at the end.
// The inner loop finds the next leaf before any triangle in it is tested. Neighbouring pixels run in step, and so do
// the same work at the same time. Software devices run every branch of the innermost loop for all pixels.
#include "common/camera_block.glsl"
#include "common/instances_f64.glsl"
#include "ray_tracing/bvh_buffers.glsl"
#include "ray_tracing/ray_box.glsl"
#include "ray_tracing/ray_triangle.glsl"
#include "ray_tracing/ray_triangle_f64.glsl"
#include RAY_MASKS

struct ShadowRay {
    dvec3 from_ca;   // from the camera's anchor, metres
    vec3 beside_m;   // from there to the receiver, along its plane; 0: it begins at the receiver
    dvec3 along;
    float last;      // its end, times `along`; kNoEnd: nowhere
    float reach;     // from there on nothing is known to stand in its way: boxes beyond are not walked
    float error_m;   // how far its beginning may be off the receiver's surface, metres
    uvec2 receiver;  // instance and triangle of that surface; kNoReceiver: not known
    uint layers;     // bits of the light's layers
};
// Distance that a place may be off its triangle's plane, in reaches of its instance. The normal is right to 2^-35 along
// each axis (lighting/gbuffer/surface_position_f64.glsl). A place may lie as far from its corner as twice the reach
// along each axis: that makes 6 times 2^-35. Bases that stretch make it twice as much.
const float kPlacedRelative = 12.0 * 2.9103830e-11;
const uvec2 kNoReceiver = uvec2(0xffffffffu);

// Ray in floats.
struct FloatRay {
    vec3 from_ca, along;
    mat3 to_frame;   // with the ray as its z axis
    float end_m;     // its end in that, metres; kNoEnd: nowhere
};

// Returns a frame with z as its third axis; the first two after Duff et al., "Building an orthonormal basis, revisited"
// (2017).
mat3 ray_frame(vec3 z) {
    float side = z.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (side + z.z), b = z.x * z.y * a;
    vec3 x = vec3(1.0 + side * z.x * z.x * a, side * b, -side * z.x), y = vec3(b, side + z.y * z.y * a, -z.y);
    return transpose(mat3(x, y, z));
}

// Triangles that floats are not sure of, or that a mask has to decide: slots of instances and of triangles. Where there
// are more than a leaf leaves room for, they are decided before the walk goes on.
const int kMostUnsure = 16, kMostInLeaf = 8;   // kMostSlots in engine/rays/bvh.h
uvec2 unsure[kMostUnsure];
int unsure_count = 0;

float largest_side(vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

// Walks a mesh from node n on, until something blocks, it is through, or there is no room for what is not sure. Returns
// whether something blocks.
bool mesh_blocks(ShadowRay exact, FloatRay ray, uint slot, RayInstance item, inout uint n) {
    InstanceRecord record = instance_record(item.instance);
    vec3 high = vec3(record.basis_x.w, record.basis_y.w, record.basis_z.w);
    precise vec3 origin_ca = (high - camera.anchor_high.xyz) + (record.low.xyz - camera.anchor_low.xyz);
    precise vec3 origin_m = origin_ca - ray.from_ca;
    float rounded_m = largest_side(origin_ca) + largest_side(ray.from_ca) + item.reach_m;
    float error_m = exact.error_m + kPlaceUnits * kUnitRoundoff * rounded_m;
    mat3 from_model = ray.to_frame * mat3(record.basis_x.xyz, record.basis_y.xyz, record.basis_z.xyz);
    vec3 origin = ray.to_frame * origin_m;
    mat3 to_model = mat3(item.to_model_x, item.to_model_y, item.to_model_z);
    BoxRay boxes = box_ray(to_model * -origin_m, to_model * ray.along, item.slack_per_m * rounded_m);

    bool blocked = false, is_beside = exact.beside_m != vec3(0.0);
    while (n < item.end_node && !blocked && unsure_count <= kMostUnsure - kMostInLeaf) {
        uint leaf = 0u;
        while (n < item.end_node && leaf == 0u) {
            RayNode node = ray_node(item.first_node + n);
            bool met = meets_box(boxes, node.low, node.high, exact.reach);
            leaf = met ? node.leaf : 0u;
            n = met ? n + 1u : node.skip;
        }
        uint first = item.first_slot + (leaf >> 4u), slots = leaf & 15u;
        for (uint i = 0u; i < slots && !blocked; ++i) {
            RayTriangle t = ray_triangle(first + i);
            int verdict = meets_triangle(from_model * t.a + origin, from_model * t.b + origin, from_model * t.c + origin,
                                         ray.end_m, error_m);
            if (t.triangle == exact.receiver.y && item.instance == exact.receiver.x) verdict = kMisses;
            bool is_open = is_beside || (kHasMasks && t.mask != kOpaque);
            if (verdict == kMeets && is_open) verdict = kUnsure;
            if (verdict == kUnsure) unsure[unsure_count++] = uvec2(slot, first + i);
            blocked = verdict == kMeets;
        }
    }
    return blocked;
}

// Returns whether a triangle that floats left open blocks the ray.
bool blocks_exactly(ShadowRay ray, uvec2 slots) {
    RayInstance item = ray_instance(slots.x);
    RayTriangle t = ray_triangle(slots.y);
    InstanceRecord record = instance_record(item.instance);
    dvec3 origin_m = exact_origin(record, camera.anchor_high.xyz, camera.anchor_low.xyz) - ray.from_ca;
    // Bases are floats, the receiver's and the caster's: planes that are one may be so far apart. Within one instance
    // they are the same.
    float units = item.instance == ray.receiver.x ? kPlacedRelative : 4.0 * kUnitRoundoff;
    float error_m = ray.error_m + units * (item.reach_m + largest_side(vec3(ray.from_ca)));
    ExactHit hit = meets_exactly(ray.along, ray.last, origin_m + exact_image(record, t.a), origin_m + exact_image(record, t.b),
                                 origin_m + exact_image(record, t.c), dvec3(ray.beside_m), error_m);
    if (kHasMasks && hit.met && t.mask != kOpaque) return is_there(t.mask, t.uvs, hit.weights);
    return hit.met;
}

bool ray_blocked(ShadowRay exact) {
    vec3 along = vec3(exact.along);
    float length_m = length(along);
    FloatRay ray = FloatRay(vec3(exact.from_ca), along, ray_frame(along / length_m), exact.last < kNoEnd ? exact.last * length_m : kNoEnd);
    RayTop head = ray_top();
    precise vec3 from_top = ray.from_ca + ((camera.anchor_high.xyz - head.anchor_high) + (camera.anchor_low.xyz - head.anchor_low));
    float rounded_m = largest_side(from_top) + largest_side(ray.from_ca) + head.reach_m;
    BoxRay boxes = box_ray(from_top, ray.along, kBoxUnits * kUnitRoundoff * rounded_m);
    uint top = 0u, n = 0u, leaf = 0u;   // node of the upper tree; node of the mesh; leaf of the upper tree, 0: none yet
    bool blocked = false, through = false;
    while (!blocked && !through) {
        unsure_count = 0;
        bool goes_on = true;
        while (goes_on) {
            while (top < head.nodes && leaf == 0u) {
                RayNode node = ray_top_node(top);
                bool met = meets_box(boxes, node.low, node.high, exact.reach);
                leaf = met ? node.leaf : 0u;
                top = met ? top + 1u : node.skip;
            }
            through = leaf == 0u;
            RayInstance item = ray_instance(leaf >> 4u);
            if (through || (item.layers & exact.layers) == 0u) item.end_node = 0u;
            n = max(n, item.begin_node);
            blocked = mesh_blocks(exact, ray, leaf >> 4u, item, n);
            goes_on = n >= item.end_node && !blocked && !through;
            if (goes_on) n = leaf = 0u;
        }
        for (int i = 0; i < unsure_count && !blocked; ++i) blocked = blocks_exactly(exact, unsure[i]);
    }
    return blocked;
}
