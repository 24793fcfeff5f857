#pragma once
#include "engine/rays/mesh_bvh.h"
#include "engine/rays/ray_packet.h"

/// Nearest hit of each of many rays: a walk through a mesh's tree, nearer children first.
namespace gnomon::rays {

/// Decides in double what a ray hits, and keeps the nearest hit.
class NearestTest {
public:
    /// Returns true if the ray hits the triangle nearer than all before; sets `t` to the place.
    virtual bool is_nearer(std::size_t ray, const BvhTriangle& triangle, double& t) = 0;

protected:
    ~NearestTest() = default;
};

/// Calls `exact` for every triangle that may be the nearest of a ray in the packet. Each nearer hit shortens its
/// segment. Equally near triangles are all tested.
void ask_nearest(const MeshBvh& tree, SegmentPacket& segments, NearestTest& exact);

}  // namespace gnomon::rays
