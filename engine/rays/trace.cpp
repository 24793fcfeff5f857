#include "engine/rays/trace.h"

#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/rays/lane_vector.h"

namespace gnomon::rays {
namespace {

/// Slack of a slab's bounds of t. Both bounds are at most 1 and round by three units each (ray_packet.cpp); 2^-20
/// exceeds the sum.
constexpr float kSlabSlack = 0x1p-20f;

float sum_of(const glm::vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// Bounds of rounding, in units of SegmentPacket::rounding (r), at least 2^-24 of the largest coordinate M. D: largest
/// component of `along`, off by r D / M. E: largest component of the triangle's sides, exact up to one rounding.
/// s: the difference `a - from`, off by 3 r, at most 2 M.
/// - cross(along, s): at most 4 D M, off by 18 r D (6 for s, 4 for along, 8 for its products and difference)
/// - its product with a side: off by 3 * 18 + 12 for the side + 36 for products and sums = 102 r D E
/// - dot(along, normal): normal at most 2 E^2 <= 4 M E, off by 8 units: 3 * 16 + 12 + 36 = 96 r D E
/// - their difference, two more sums: 102 + 102 + 96 + 72 = 372 r D E
/// - dot(s, normal): 3 * (2 * 3 + 2 * 8) + 18 + 18 = 102 r E^2, of terms of at most 4 M E^2
constexpr float kSideUnits = 400.0f, kDistanceUnits = 128.0f;
/// Bound on the error of products that underflow, for coordinates of at least 1e-9.
constexpr float kUnderflow = 0x1p-120f;

/// Returns the lanes of a vector with segments near the widened box.
LaneVector near_widened(const SegmentPacket& segments, std::size_t v, const glm::vec3& low, const glm::vec3& high) {
    const FloatVector from_x = load(segments.from[0], v), inverse_x = load(segments.inverse[0], v);
    const FloatVector from_y = load(segments.from[1], v), inverse_y = load(segments.inverse[1], v);
    const FloatVector from_z = load(segments.from[2], v), inverse_z = load(segments.inverse[2], v);
    const FloatVector x0 = (low.x - from_x) * inverse_x, x1 = (high.x - from_x) * inverse_x;
    const FloatVector y0 = (low.y - from_y) * inverse_y, y1 = (high.y - from_y) * inverse_y;
    const FloatVector z0 = (low.z - from_z) * inverse_z, z1 = (high.z - from_z) * inverse_z;
    const FloatVector enter = higher(higher(lower(x0, x1), lower(y0, y1)), higher(lower(z0, z1), FloatVector{}));
    const FloatVector leave =
        lower(lower(higher(x0, x1), higher(y0, y1)), lower(higher(z0, z1), load(segments.last, v)));
    return enter <= leave + kSlabSlack;
}

bool any_near(const SegmentPacket& segments, const BvhNode& node) {
    const glm::vec3 low = node.min - segments.box_slack, high = node.max + segments.box_slack;
    for (std::size_t v = 0; v < vectors_of(segments.lanes); ++v)
        if (any(near_widened(segments, v, low, high))) return true;
    return false;
}

template <class Test>
void test_slots(const MeshBvh& tree, const BvhNode& leaf, Test&& test) {
    for (std::uint32_t slot = leaf.first_slot(); slot < leaf.first_slot() + leaf.slots(); ++slot)
        test(tree.triangles()[slot]);
}

/// Calls test(triangle) for every triangle that a segment may hit, in the nodes' order. `test` may drop segments; the
/// walk ends without any. Cheaper than walk_nearer_first() where any hit ends a segment (./gnomon bench queries).
template <class Test>
void walk(const MeshBvh& tree, const SegmentPacket& segments, Test&& test) {
    const std::span<const BvhNode> nodes = tree.nodes();
    for (std::uint32_t n = 0; n < nodes.size() && segments.lanes != 0;) {
        const BvhNode& node = nodes[n];
        const bool near = any_near(segments, node);
        if (near) test_slots(tree, node, test);
        n = near ? n + 1 : node.skip;
    }
}

/// Returns the direction of the packet's first ray. Rays that start close together have similar directions.
glm::vec3 way_of(const SegmentPacket& segments) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(segments.lanes));
    return {segments.along[0][lane], segments.along[1][lane], segments.along[2][lane]};
}

glm::vec3 twice_middle(const BvhNode& node) { return node.min + node.max; }

/// Calls test(triangle) for every triangle that a segment may hit, nearer children first. `test` may shorten segments.
template <class Test>
void walk_nearer_first(const MeshBvh& tree, const SegmentPacket& segments, Test&& test) {
    const std::span<const BvhNode> nodes = tree.nodes();
    if (nodes.empty() || segments.lanes == 0) return;
    const glm::vec3 way = way_of(segments);
    std::array<std::uint32_t, kMostDepth + 1> waiting;  // farther child of each level above
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const std::uint32_t n = waiting[--count];
        const BvhNode& node = nodes[n];
        if (!any_near(segments, node)) continue;
        test_slots(tree, node, test);
        if (node.leaf != 0) continue;
        const std::uint32_t one = n + 1, other = nodes[one].skip;
        const bool one_first = glm::dot(twice_middle(nodes[other]) - twice_middle(nodes[one]), way) >= 0.0f;
        waiting[count++] = one_first ? other : one;
        waiting[count++] = one_first ? one : other;
    }
}

}  // namespace

Lanes near_box(const SegmentPacket& segments, const glm::vec3& min, const glm::vec3& max) {
    const glm::vec3 low = min - segments.box_slack, high = max + segments.box_slack;
    Lanes near = 0;
    for (std::size_t v = 0; v < vectors_of(segments.lanes); ++v)
        near |= lanes_of(near_widened(segments, v, low, high), v);
    return near;
}

Verdict judge(const SegmentPacket& segments, const BvhTriangle& triangle) {
    const glm::vec3 ab = triangle.b - triangle.a, ac = triangle.c - triangle.a;
    const glm::vec3 normal(ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z, ab.x * ac.y - ab.y * ac.x);
    const float side = std::fmax(sum_of(ab), sum_of(ac));
    const float side_error = kSideUnits * segments.rounding * side;  // relative to the lane's size
    const float distance_error = kDistanceUnits * segments.rounding * side * side + kUnderflow;
    Verdict verdict;
    for (std::size_t v = 0; v < vectors_of(segments.lanes); ++v) {
        const FloatVector dx = load(segments.along[0], v), dy = load(segments.along[1], v),
                          dz = load(segments.along[2], v);
        const FloatVector sx = triangle.a.x - load(segments.from[0], v), sy = triangle.a.y - load(segments.from[1], v),
                          sz = triangle.a.z - load(segments.from[2], v);
        const FloatVector rx = dy * sz - dz * sy, ry = dz * sx - dx * sz, rz = dx * sy - dy * sx;
        const FloatVector slope = dx * normal.x + dy * normal.y + dz * normal.z;
        const FloatVector b = -(rx * ac.x + ry * ac.y + rz * ac.z), c = rx * ab.x + ry * ab.y + rz * ab.z;
        const FloatVector a = slope - b - c;
        const FloatVector error = side_error * load(segments.size, v) + kUnderflow;
        const FloatVector least = lower(lower(a, b), c), most = higher(higher(a, b), c);
        const LaneVector alive = load(segments.last, v) > 0.0f;
        const LaneVector beside = (least < -error) & (most > error);
        const LaneVector open = alive & ~beside;
        if (!any(open)) continue;
        const FloatVector distance = sx * normal.x + sy * normal.y + sz * normal.z;
        const FloatVector way = slope < 0.0f ? -distance : distance, whole = absolute(slope);
        const LaneVector through = (least > error) | (most < -error);  // the slope's sign is certain, too
        const LaneVector between = (way > distance_error) & (way < whole - distance_error - error);
        const LaneVector apart = (way < -distance_error) | (way > whole + distance_error + error);
        const LaneVector hit = open & through & between;
        verdict.hit |= lanes_of(hit, v);
        verdict.unsure |= lanes_of(open & ~hit & ~(through & apart), v);
    }
    return verdict;
}

Lanes blocked_rays(const MeshBvh& tree, SegmentPacket& segments, ExactTest& exact) {
    const Lanes wanted = segments.lanes;
    walk(tree, segments, [&](const BvhTriangle& triangle) {
        Verdict verdict = judge(segments, triangle);
        if (triangle.mask != kOpaque) verdict = {0, verdict.hit | verdict.unsure};
        double t = 0.0;
        for (Lanes open = verdict.unsure; open != 0; open &= open - 1u) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(open));
            if (exact.hits(segments.ray[lane], triangle, t)) verdict.hit |= 1u << lane;
        }
        segments.drop(verdict.hit);
    });
    return segments.rays_of(wanted & ~segments.lanes);
}

void nearest_hits(const MeshBvh& tree, SegmentPacket& segments, ExactTest& exact) {
    walk_nearer_first(tree, segments, [&](const BvhTriangle& triangle) {
        const Verdict verdict = judge(segments, triangle);
        double t = 0.0;
        for (Lanes open = verdict.hit | verdict.unsure; open != 0; open &= open - 1u) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(open));
            if (exact.hits(segments.ray[lane], triangle, t)) segments.shorten(lane, t);
        }
    });
}

}  // namespace gnomon::rays
