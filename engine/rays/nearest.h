#pragma once
#include "engine/rays/mesh_bvh.h"
#include "engine/rays/ray_packet.h"

/// What each of many rays meets first: the walk through a mesh's tree, nearer children first.
namespace gnomon::rays {

/// Decides in double what a ray meets, and keeps the nearest.
class NearestTest {
public:
    /// Whether the ray meets the triangle, nearer than all before; then `t` is where.
    virtual bool is_nearer(std::size_t ray, const BvhTriangle& triangle, double& t) = 0;

protected:
    ~NearestTest() = default;
};

/// Asks `exact` of every triangle that may be the first that a ray of the packet meets. What it says nearer shortens
/// the segments. Equally near triangles are all asked.
void ask_nearest(const MeshBvh& tree, SegmentPacket& segments, NearestTest& exact);

}  // namespace gnomon::rays
