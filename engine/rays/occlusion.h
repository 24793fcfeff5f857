#pragma once
#include <cstdint>
#include <span>

#include "engine/rays/mesh_bvh.h"
#include "engine/rays/ray_packet.h"

/// Which of many rays something blocks: the walk through a mesh's tree.
namespace gnomon::rays {

/// Lanes whose segments come near the box; never leaves one out that meets it.
Lanes near_box(const SegmentPacket& segments, const glm::vec3& min, const glm::vec3& max);

/// What float can say about segments and a triangle. Lanes in neither miss it for sure.
struct Verdict {
    Lanes hit = 0;     // for sure, and not where it begins or ends
    Lanes unsure = 0;  // too near to an edge or an end: double has to decide
};
Verdict judge(const SegmentPacket& segments, const BvhTriangle& triangle);

/// Decides what float leaves open, and what an alpha mask decides.
class ExactTest {
public:
    virtual bool blocks(std::size_t ray, const BvhTriangle& triangle) = 0;

protected:
    ~ExactTest() = default;
};

/// Rays of the packet that some triangle blocks, a bit each; their lanes are dropped from `segments`. The answer is
/// that of `exact` for every triangle.
Lanes blocked_rays(const MeshBvh& tree, SegmentPacket& segments, ExactTest& exact);

}  // namespace gnomon::rays
