#include "engine/rays/nearest.h"

#include <array>
#include <bit>
#include <glm/geometric.hpp>

#include "engine/rays/occlusion.h"

namespace gnomon::rays {
namespace {

/// Returns the direction of the packet's first ray. Rays that start close together have similar directions.
glm::vec3 variant_of(const SegmentPacket& segments) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(segments.lanes));
    return {segments.along[0][lane], segments.along[1][lane], segments.along[2][lane]};
}

glm::vec3 twice_middle(const BvhNode& node) { return node.min + node.max; }

void ask_leaf(const MeshBvh& tree, const BvhNode& leaf, SegmentPacket& segments, NearestTest& exact) {
    for (std::uint32_t slot = leaf.first_slot(); slot < leaf.first_slot() + leaf.slots(); ++slot) {
        const BvhTriangle& triangle = tree.triangles()[slot];
        const Verdict verdict = judge(segments, triangle);
        for (Lanes open = verdict.hit | verdict.unsure; open != 0; open &= open - 1u) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(open));
            double t = 0.0;
            if (exact.is_nearer(segments.ray[lane], triangle, t)) segments.shorten(lane, t);
        }
    }
}

}  // namespace

void ask_nearest(const MeshBvh& tree, SegmentPacket& segments, NearestTest& exact) {
    const std::span<const BvhNode> nodes = tree.nodes();
    if (nodes.empty() || segments.lanes == 0) return;
    const glm::vec3 way = variant_of(segments);
    std::array<std::uint32_t, kMostDepth + 1> waiting;  // farther child of each level above
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const std::uint32_t n = waiting[--count];
        const BvhNode& node = nodes[n];
        if (near_box(segments, node.min, node.max) == 0) continue;
        if (node.leaf != 0) {
            ask_leaf(tree, node, segments, exact);
            continue;
        }
        const std::uint32_t one = n + 1, other = nodes[one].skip;
        const bool one_first = glm::dot(twice_middle(nodes[other]) - twice_middle(nodes[one]), way) >= 0.0f;
        waiting[count++] = one_first ? other : one;
        waiting[count++] = one_first ? one : other;
    }
}

}  // namespace gnomon::rays
