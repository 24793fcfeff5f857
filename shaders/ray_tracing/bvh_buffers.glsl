// Trees that rays walk: one over the instances that cast, and one over the triangles of each mesh, in the mesh's own
// space. There are no positions of the world: the upper tree is relative to an anchor, given as two floats. C++ twins:
// RayTop and RayInstance in systems/visibility/ray_records.h, BvhNode and BvhTriangle in engine/rays.
#include "common/bindings.glsl"
#include "common/instances.glsl"

// Node in the order of a walk: from node n to n + 1 where its box is met, else to `skip`.
struct RayNode {
    vec3 low;
    uint skip;
    vec3 high;
    uint leaf;       // its first slot * 16 + number of slots; 0: not a leaf
};
struct RayTriangle {
    vec3 a;
    uint triangle;   // its number in the common index buffer
    vec3 b;
    uint mask;       // see ray_tracing/alpha_mask.glsl; kOpaque: there is none
    vec3 c;
    uint uvs;        // place of its texture coordinates among the masks
};
// Slot of the upper tree: an instance, or part of a large one's mesh.
struct RayInstance {
    vec3 to_model_x;      // image of the world's x axis in the mesh's space
    uint first_node;
    vec3 to_model_y;
    uint end_node;        // end of the nodes to be walked, from the mesh's first on
    vec3 to_model_z;
    uint first_slot;      // first slot of its mesh's triangles
    float slack_per_m;    // by which boxes of its mesh are widened, per metre of what is rounded
    float reach_m;        // how far its corners lie from its own origin, along any axis, metres
    uint instance;        // index into `instances`
    uint layers;          // bits of the light layers that it darkens
    uint begin_node;      // first of those nodes
};
// Head of the upper tree: its anchor and size.
struct RayTop {
    vec3 anchor_high;
    uint nodes;
    vec3 anchor_low;
    float reach_m;        // farthest side of a box from the anchor, along any axis, metres
};
// Texels, since software devices fetch four numbers at once from those: two per node, three per triangle, five per
// instance. The upper tree's head takes two, its nodes follow.
layout(binding = kRayNodeUnit) uniform usamplerBuffer ray_nodes;
layout(binding = kRayTriangleUnit) uniform usamplerBuffer ray_triangles;
layout(binding = kRayTopUnit) uniform usamplerBuffer ray_upper;
layout(binding = kRayInstanceUnit) uniform usamplerBuffer ray_instances;

RayNode node_of(uvec4 low, uvec4 high) { return RayNode(uintBitsToFloat(low.xyz), low.w, uintBitsToFloat(high.xyz), high.w); }

RayTop ray_top() {
    uvec4 high = texelFetch(ray_upper, 0), low = texelFetch(ray_upper, 1);
    return RayTop(uintBitsToFloat(high.xyz), high.w, uintBitsToFloat(low.xyz), uintBitsToFloat(low.w));
}

RayNode ray_top_node(uint place) {
    int texel = 2 + 2 * int(place);
    return node_of(texelFetch(ray_upper, texel), texelFetch(ray_upper, texel + 1));
}

RayInstance ray_instance(uint slot) {
    int texel = 5 * int(slot);
    uvec4 x = texelFetch(ray_instances, texel), y = texelFetch(ray_instances, texel + 1), z = texelFetch(ray_instances, texel + 2);
    uvec4 more = texelFetch(ray_instances, texel + 3);
    return RayInstance(uintBitsToFloat(x.xyz), x.w, uintBitsToFloat(y.xyz), y.w, uintBitsToFloat(z.xyz), z.w,
                       uintBitsToFloat(more.x), uintBitsToFloat(more.y), more.z, more.w, texelFetch(ray_instances, texel + 4).x);
}

RayNode ray_node(uint place) {
    int texel = 2 * int(place);
    return node_of(texelFetch(ray_nodes, texel), texelFetch(ray_nodes, texel + 1));
}

RayTriangle ray_triangle(uint slot) {
    int texel = 3 * int(slot);
    uvec4 a = texelFetch(ray_triangles, texel), b = texelFetch(ray_triangles, texel + 1), c = texelFetch(ray_triangles, texel + 2);
    return RayTriangle(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w);
}

const uint kOpaque = 0xffffffffu;
