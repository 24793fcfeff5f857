// What rays are asked of: a tree over the instances that cast, and one over the triangles of each mesh, in the mesh's own
// space. No positions of the world: the upper tree is relative to an anchor, given as two floats.
// C++ twins: RayTop and RayInstance in systems/visibility/ray_records.h, BvhNode and BvhTriangle in engine/rays.
#include "shared/instances.glsl"

// Nodes lie in the order of a walk: from node n to n + 1 where its box is met, else to `skip`.
struct RayNode {
    vec3 low;
    uint skip;
    vec3 high;
    uint leaf;       // its first slot * 16 + how many; 0: not a leaf
};
struct RayTriangle {
    vec3 a;
    uint triangle;   // of the common index buffer
    vec3 b;
    uint mask;       // see rays/alpha_mask.glsl; kOpaque: there is none
    vec3 c;
    uint uvs;        // its texture coordinates there
};
// By slot of the upper tree.
struct RayInstance {
    vec3 to_model_x;      // image of the world's x axis in the mesh's space
    uint first_node;
    vec3 to_model_y;
    uint nodes;           // of its mesh
    vec3 to_model_z;
    uint first_slot;      // of its mesh's triangles
    float slack_per_m;    // by which boxes of its mesh are widened, per metre of what is rounded
    float reach_m;        // how far its corners lie from its own origin, along any axis
    uint instance;        // of `instances`
    uint layers;          // of light that it darkens
};
// Two texels a node, three a triangle: each three floats and a number.
layout(binding = 10) uniform usamplerBuffer ray_nodes;
layout(binding = 11) uniform usamplerBuffer ray_triangles;

RayNode ray_node(uint place) {
    int texel = 2 * int(place);
    uvec4 low = texelFetch(ray_nodes, texel), high = texelFetch(ray_nodes, texel + 1);
    return RayNode(uintBitsToFloat(low.xyz), low.w, uintBitsToFloat(high.xyz), high.w);
}

RayTriangle ray_triangle(uint slot) {
    int texel = 3 * int(slot);
    uvec4 a = texelFetch(ray_triangles, texel), b = texelFetch(ray_triangles, texel + 1), c = texelFetch(ray_triangles, texel + 2);
    return RayTriangle(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w);
}

layout(std430, binding = 5) readonly buffer RayTopBuffer {
    vec3 anchor_high;
    uint nodes;
    vec3 anchor_low;
    float reach_m;        // farthest side of a box from the anchor, along any axis
    RayNode node[];
} ray_top;
layout(std430, binding = 6) readonly buffer RayInstanceBuffer { RayInstance ray_instances[]; };

const uint kOpaque = 0xffffffffu;
