#include "systems/visibility/blocked_rays.h"

#include "systems/visibility/scene_walk.h"

namespace gnomon::visibility {
namespace {

/// Decides exactly, for one instance.
class InstanceTest final : public rays::ExactTest {
public:
    InstanceTest(const assets::MeshLibrary& library, const InstanceItem& item, const rays::RayPacket& rays)
        : library_(library), item_(item), rays_(rays) {}

    bool hits(std::size_t ray, const rays::BvhTriangle& triangle, double&) override {
        const glm::dvec3& from_ws_m = rays_.from[ray];
        const rays::ExactTriangle exact = placed(item_, triangle, from_ws_m);
        rays::ExactHit hit;
        if (!rays::meets(rays_.along[ray], exact, hit)) return false;
        if (!(hit.t > rays_.first[ray])) return false;
        const double error_m = corner_error_m(item_, exact, from_ws_m);
        if (rays::begins_on_plane(exact, error_m)) return false;
        // A lamp in the triangle's plane counts as in front of it.
        const bool on_front = rays::ends_on_plane(rays_.along[ray] * rays_.last, exact, error_m);
        if (on_front ? rays::begins_before(exact) != item_.winding.mirrored : !(hit.t < rays_.last)) return false;
        return is_there(library_, item_, triangle, hit);
    }

private:
    const assets::MeshLibrary& library_;
    const InstanceItem& item_;
    const rays::RayPacket& rays_;
};

}  // namespace

rays::Lanes blocked_rays(const SceneSnapshot& scene, const CasterTrees& trees, ShadowLayers layers,
                         const rays::RayPacket& rays, std::uint32_t& hint) {
    const auto casts = [layers](const InstanceItem& item) { return item.casts && (item.cast_layers & layers) != 0; };
    rays::Lanes blocked = 0;
    SceneWalk walk(scene, trees, rays);
    walk.visit(hint, casts, [&](std::uint32_t instance, const rays::MeshBvh& tree, rays::SegmentPacket& segments) {
        InstanceTest exact(trees.library(), scene.instances[instance], rays);
        const rays::Lanes hit = rays::blocked_rays(tree, segments, exact);
        if (hit == 0) return;
        blocked |= hit;
        hint = instance;
        walk.drop(hit);
    });
    return blocked;
}

}  // namespace gnomon::visibility
