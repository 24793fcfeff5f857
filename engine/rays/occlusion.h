#pragma once
#include <cstdint>
#include <span>

#include "engine/rays/mesh_bvh.h"
#include "engine/rays/ray_packet.h"

/// Occlusion of many rays: a walk through a mesh's tree.
namespace gnomon::rays {

/// Returns the lanes with segments near the box. Conservative: includes every segment that hits it.
Lanes near_box(const SegmentPacket& segments, const glm::vec3& min, const glm::vec3& max);

/// Result of float arithmetic for segments against a triangle. Lanes in neither set miss it for certain.
struct Verdict {
    Lanes hit = 0;     // certain, and not at the segment's ends
    Lanes unsure = 0;  // too close to an edge or an end: decided in double
};
Verdict judge(const SegmentPacket& segments, const BvhTriangle& triangle);

/// Decides the cases that float leaves open, and alpha masks.
class ExactTest {
public:
    virtual bool blocks(std::size_t ray, const BvhTriangle& triangle) = 0;

protected:
    ~ExactTest() = default;
};

/// Returns the rays of the packet that a triangle blocks, a bit each, and drops their lanes from `segments`. The result
/// equals that of calling `exact` for every triangle.
Lanes blocked_rays(const MeshBvh& tree, SegmentPacket& segments, ExactTest& exact);

}  // namespace gnomon::rays
