#include "systems/visibility/blocked_rays.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/rays/alpha_mask.h"
#include "engine/rays/exact_triangle.h"
#include "engine/rays/occlusion.h"
#include "systems/extract/scene_tree.h"

namespace gnomon::visibility {
namespace {

using rays::Lanes;

/// Rounding of corners relative to the place, and of the plane through three of them. A dozen operations on numbers no
/// larger than the coordinates.
constexpr double kPlaneUnits = 64.0 * 0x1p-53;

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Decides exactly, for one instance.
class InstanceTest final : public rays::ExactTest {
public:
    InstanceTest(const assets::MeshLibrary& library, const InstanceItem& item, const rays::RayPacket& rays)
        : library_(library), item_(item), rays_(rays) {}

    bool blocks(std::size_t ray, const rays::BvhTriangle& triangle) override {
        const glm::dvec3& from_ws_m = rays_.from[ray];
        const glm::dvec3 origin_m = item_.translation_ws_m - from_ws_m;
        const auto placed = [&](const glm::vec3& corner) { return item_.basis * glm::dvec3(corner) + origin_m; };
        const rays::ExactTriangle exact{placed(triangle.a), placed(triangle.b), placed(triangle.c)};
        rays::ExactHit hit;
        if (!rays::meets(rays_.along[ray], exact, hit)) return false;
        if (!(hit.t > rays_.first[ray])) return false;
        const double size_m = largest(from_ws_m) + largest(item_.translation_ws_m) + largest(exact.a) +
                              largest(exact.b) + largest(exact.c);
        const double error_m = kPlaneUnits * size_m;
        if (rays::begins_on_plane(exact, error_m)) return false;
        // A lamp in the triangle's plane counts as in front of it.
        const bool on_front = rays::ends_on_plane(rays_.along[ray] * rays_.last, exact, error_m);
        if (on_front ? rays::begins_before(exact) != item_.mirrored : !(hit.t < rays_.last)) return false;
        return triangle.mask == rays::kOpaque ||
               rays::is_there(library_, library_.meshes[item_.mesh], triangle.triangle, triangle.mask, hit.weights);
    }

private:
    const assets::MeshLibrary& library_;
    const InstanceItem& item_;
    const rays::RayPacket& rays_;
};

math::Aabb bounds_of(const SceneSnapshot& scene) {
    if (has_tree(scene)) return scene.tree.box();
    math::Aabb all;
    for (const InstanceItem& item : scene.instances) all = math::merged(all, item.bounds_ws);
    return all;
}

/// Walk of a packet's rays through the instances.
class Walk {
public:
    Walk(const SceneSnapshot& scene, const CasterTrees& trees, ShadowLayers layers, const rays::RayPacket& rays,
         std::uint32_t& hint)
        : scene_(scene), trees_(trees), layers_(layers), rays_(rays), hint_(hint) {}

    Lanes blocked() {
        const math::Aabb bounds = bounds_of(scene_);
        if (math::is_empty(bounds)) return 0;
        const rays::Frame world{glm::dmat3(1.0), math::centre(bounds)};
        const auto boxed = [&](const math::Aabb& box) {
            return rays::Box{glm::vec3(box.min - world.origin_ws_m), glm::vec3(box.max - world.origin_ws_m)};
        };
        rays::cut_to(boxed(bounds), rays::in_frame(rays_, rays_.lanes(), world), rays_.lanes(), open_);
        const Lanes asked = open_.lanes;
        const std::uint32_t first = hint_;
        if (first < scene_.instances.size() && !math::is_empty(scene_.instances[first].bounds_ws)) {
            const rays::Box part = boxed(scene_.instances[first].bounds_ws);
            if (const Lanes close = rays::near_box(open_, part.min, part.max); close != 0) enter(first, close);
        }
        Lanes near = 0;
        visit_instances(
            scene_,
            [&](const math::Aabb& box) {
                if (open_.lanes == 0 || math::is_empty(box)) return math::Overlap::outside;
                const rays::Box part = boxed(box);
                near = rays::near_box(open_, part.min, part.max);
                return near == 0 ? math::Overlap::outside : math::Overlap::partial;
            },
            [&](std::uint32_t instance) {
                if (instance != first) enter(instance, near);
            });
        return open_.rays_of(asked & ~open_.lanes);
    }

private:
    void enter(std::uint32_t instance, Lanes near) {
        const InstanceItem& item = scene_.instances[instance];
        const rays::MeshBvh* tree = trees_.tree(item.mesh);
        if (!item.casts || (item.cast_layers & layers_) == 0 || !tree) return;
        const rays::Frame frame{item.basis, item.translation_ws_m};
        if (!framed_ || frame != frame_) {
            framed_rays_ = rays::in_frame(rays_, open_.rays_of(open_.lanes), frame);
            frame_ = frame;
            framed_ = true;
        }
        rays::cut_to(tree->box(), framed_rays_, open_.rays_of(near), segments_);
        InstanceTest exact(trees_.library(), item, rays_);
        const Lanes blocked = rays::blocked_rays(*tree, segments_, exact);
        if (blocked != 0) hint_ = instance;
        for (Lanes open = open_.lanes; open != 0 && blocked != 0; open &= open - 1u) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(open));
            if (blocked >> open_.ray[lane] & 1u) open_.drop(1u << lane);
        }
    }

    const SceneSnapshot& scene_;
    const CasterTrees& trees_;
    ShadowLayers layers_;
    const rays::RayPacket& rays_;
    std::uint32_t& hint_;
    rays::SegmentPacket open_;  // not blocked so far; relative to the middle of the scene
    rays::SegmentPacket segments_;
    rays::FramedRays framed_rays_;
    rays::Frame frame_;  // frame of framed_rays_
    bool framed_ = false;
};

}  // namespace

Lanes blocked_rays(const SceneSnapshot& scene, const CasterTrees& trees, ShadowLayers layers,
                   const rays::RayPacket& rays, std::uint32_t& hint) {
    return Walk(scene, trees, layers, rays, hint).blocked();
}

}  // namespace gnomon::visibility
