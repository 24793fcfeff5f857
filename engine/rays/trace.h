#pragma once
#include "engine/rays/mesh_bvh.h"
#include "engine/rays/ray_packet.h"

/// Hits of many rays with the triangles of a mesh: walks through its tree.
namespace gnomon::rays {

/// Returns the lanes with segments near the box. Conservative: includes every segment that hits it.
Lanes near_box(const SegmentPacket& segments, const glm::vec3& min, const glm::vec3& max);

/// Result of float arithmetic for segments against a triangle. Lanes in neither set miss it for certain.
struct Verdict {
    Lanes hit = 0;     // certain, and not at the segment's ends
    Lanes unsure = 0;  // too close to an edge or an end: decided in double
};
Verdict judge(const SegmentPacket& segments, const BvhTriangle& triangle);

/// Decides in double what float leaves open, and alpha masks.
class ExactTest {
public:
    /// Returns true if the ray's hit with the triangle counts. For nearest_hits() that is one nearer than all before;
    /// `t` is then its place.
    virtual bool hits(std::size_t ray, const BvhTriangle& triangle, double& t) = 0;

protected:
    ~ExactTest() = default;
};

/// Returns the rays of the packet that a triangle blocks, a bit each, and drops their lanes from `segments`. The result
/// equals that of calling `exact` for every triangle.
Lanes blocked_rays(const MeshBvh& tree, SegmentPacket& segments, ExactTest& exact);

/// Calls `exact` for every triangle that may be the nearest of a ray in the packet. Each nearer hit shortens its
/// segment. Equally near triangles are all tested.
void nearest_hits(const MeshBvh& tree, SegmentPacket& segments, ExactTest& exact);

}  // namespace gnomon::rays
