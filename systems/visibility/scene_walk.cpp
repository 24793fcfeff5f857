#include "systems/visibility/scene_walk.h"

#include "engine/rays/transmittance.h"

namespace gnomon::visibility {
namespace {

math::Aabb bounds_of(const SceneSnapshot& scene) {
    if (has_tree(scene)) return scene.tree.box();
    math::Aabb all;
    for (const InstanceItem& item : scene.instances) all = math::merged(all, item.bounds_ws);
    return all;
}

/// Rounding of corners relative to the place, and of the plane through three of them. A dozen operations on numbers no
/// larger than the coordinates.
constexpr double kPlaneUnits = 64.0 * 0x1p-53;

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

SceneWalk::SceneWalk(const SceneSnapshot& scene, const CasterTrees& trees, const rays::RayPacket& rays)
    : scene_(scene), trees_(trees), rays_(rays) {
    const math::Aabb bounds = bounds_of(scene);
    if (math::is_empty(bounds)) return;
    middle_ws_m_ = math::centre(bounds);
    rays::cut_to(boxed(bounds), rays::in_frame(rays, rays.lanes(), {glm::dmat3(1.0), middle_ws_m_}), rays.lanes(),
                 open_);
}

rays::Box SceneWalk::boxed(const math::Aabb& box_ws) const {
    return {glm::vec3(box_ws.min - middle_ws_m_), glm::vec3(box_ws.max - middle_ws_m_)};
}

rays::Lanes SceneWalk::near_lanes(const math::Aabb& box_ws) const {
    if (open_.lanes == 0 || math::is_empty(box_ws)) return 0;
    const rays::Box box = boxed(box_ws);
    return rays::near_box(open_, box.min, box.max);
}

void SceneWalk::cut_to(const rays::MeshBvh& tree, const InstanceItem& item, rays::Lanes near) {
    const rays::Frame frame{item.basis, item.translation_ws_m};
    if (!framed_ || frame != frame_) {
        framed_rays_ = rays::in_frame(rays_, open_.rays_of(open_.lanes), frame);
        frame_ = frame;
        framed_ = true;
    }
    rays::cut_to(tree.box(), framed_rays_, open_.rays_of(near), segments_);
}

void SceneWalk::drop(rays::Lanes rays) {
    for (rays::Lanes lanes = open_.lanes; lanes != 0 && rays != 0; lanes &= lanes - 1u) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
        if (rays >> open_.ray[lane] & 1u) open_.drop(1u << lane);
    }
}

void SceneWalk::shorten(std::size_t ray, double t) {
    for (rays::Lanes lanes = open_.lanes; lanes != 0; lanes &= lanes - 1u) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
        if (open_.ray[lane] == ray) open_.shorten(lane, t);
    }
}

rays::ExactTriangle placed(const InstanceItem& item, const rays::BvhTriangle& triangle, const glm::dvec3& from_ws_m) {
    const glm::dvec3 origin_m = item.translation_ws_m - from_ws_m;
    const auto corner = [&](const glm::vec3& corner_ms) { return item.basis * glm::dvec3(corner_ms) + origin_m; };
    return {corner(triangle.a), corner(triangle.b), corner(triangle.c)};
}

double corner_error_m(const InstanceItem& item, const rays::ExactTriangle& triangle, const glm::dvec3& from_ws_m) {
    return kPlaneUnits * (largest(from_ws_m) + largest(item.translation_ws_m) + largest(triangle.a) +
                          largest(triangle.b) + largest(triangle.c));
}

bool is_there(const assets::MeshLibrary& library, const InstanceItem& item, const rays::BvhTriangle& triangle,
              const rays::ExactHit& hit) {
    return triangle.mask == rays::kOpaque ||
           rays::is_there(library, library.meshes[item.mesh], triangle.triangle, triangle.mask, hit.weights);
}

}  // namespace gnomon::visibility
