#pragma once
#include <bit>

#include "engine/rays/exact_triangle.h"
#include "engine/rays/trace.h"
#include "systems/extract/scene_tree.h"
#include "systems/visibility/caster_trees.h"

namespace gnomon::visibility {

/// Walk of a packet's rays through both levels of the trees: the snapshot's over instances, then each mesh's own.
/// `trees` must belong to the scene. Refers to its arguments, which must outlive the walk.
class SceneWalk {
public:
    SceneWalk(const SceneSnapshot& scene, const CasterTrees& trees, const rays::RayPacket& rays);

    /// Calls enter(instance, tree, segments) for each instance with rays near it, if wanted(item) and its mesh has a
    /// tree. `segments` are those rays in the mesh's space, cut to the tree's box. `first`: instance to enter before
    /// all others; it affects only time.
    template <class Wanted, class Enter>
    void visit(std::uint32_t first, Wanted&& wanted, Enter&& enter) {
        rays::Lanes near = 0;
        const auto enter_if_wanted = [&](std::uint32_t instance) {
            const rays::MeshBvh* tree = trees_.tree(scene_.instances[instance].mesh);
            if (near == 0 || !tree || !wanted(scene_.instances[instance])) return;
            cut_to(*tree, scene_.instances[instance], near);
            enter(instance, *tree, segments_);
        };
        if (first < scene_.instances.size()) {
            near = near_lanes(scene_.instances[first].bounds_ws);
            enter_if_wanted(first);
        }
        const auto classify = [&](const math::Aabb& box_ws) {
            near = near_lanes(box_ws);
            return near == 0 ? math::Overlap::outside : math::Overlap::partial;
        };
        visit_instances(scene_, classify, [&](std::uint32_t instance) {
            if (instance != first) enter_if_wanted(instance);
        });
    }

    /// Excludes rays of the packet, a bit each, from the rest of the walk.
    void drop(rays::Lanes rays);
    /// Ends a ray at `t` for the rest of the walk.
    void shorten(std::size_t ray, double t);

private:
    rays::Box boxed(const math::Aabb& box_ws) const;
    rays::Lanes near_lanes(const math::Aabb& box_ws) const;
    void cut_to(const rays::MeshBvh& tree, const InstanceItem& item, rays::Lanes near);

    const SceneSnapshot& scene_;
    const CasterTrees& trees_;
    const rays::RayPacket& rays_;
    glm::dvec3 middle_ws_m_{0.0};
    rays::SegmentPacket open_;      // relative to the middle of the scene
    rays::SegmentPacket segments_;  // scratch
    rays::FramedRays framed_rays_;
    rays::Frame frame_;  // frame of framed_rays_
    bool framed_ = false;
};

/// Computes the corners of an instance's triangle relative to a ray's origin.
rays::ExactTriangle placed(const InstanceItem& item, const rays::BvhTriangle& triangle, const glm::dvec3& from_ws_m);

/// Bounds the rounding of placed() corners, and of the plane through them.
double corner_error_m(const InstanceItem& item, const rays::ExactTriangle& triangle, const glm::dvec3& from_ws_m);

/// Returns false if the triangle's mask lets light through at the hit.
bool is_there(const assets::MeshLibrary& library, const InstanceItem& item, const rays::BvhTriangle& triangle,
              const rays::ExactHit& hit);

}  // namespace gnomon::visibility
