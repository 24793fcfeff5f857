#include "systems/truth/seen_surfaces.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "engine/rays/alpha_mask.h"
#include "engine/rays/exact_triangle.h"
#include "engine/rays/nearest.h"
#include "engine/rays/occlusion.h"
#include "systems/extract/scene_tree.h"
#include "systems/truth/picture_ray.h"

namespace gnomon::truth {
namespace {

using rays::Lanes;

struct Hit {
    double t = std::numeric_limits<double>::infinity();
    std::uint32_t instance = kNoSurface, triangle = 0;
    glm::dvec3 front{0.0};   // counter-clockwise side, not normalised
    glm::dvec3 corner{0.0};  // relative to the ray's origin
};

bool is_double_sided(const assets::MeshLibrary& library, const assets::Mesh& mesh, std::uint32_t triangle) {
    for (const assets::Submesh& part : mesh.submeshes)
        if (3 * triangle - part.first_index < part.index_count) return library.materials[part.material].double_sided;
    return false;
}

/// Hits of a packet's rays with one instance.
class InstanceSight final : public rays::NearestTest {
public:
    InstanceSight(const assets::MeshLibrary& library, const InstanceItem& item, std::uint32_t instance,
                  const rays::RayPacket& rays, rays::PerLane<Hit>& hits)
        : library_(library), item_(item), instance_(instance), rays_(rays), hits_(hits) {}

    bool is_nearer(std::size_t ray, const rays::BvhTriangle& triangle, double& t) override {
        const glm::dvec3 origin_m = item_.translation_ws_m - rays_.from[ray];
        const auto placed = [&](const glm::vec3& corner) { return item_.basis * glm::dvec3(corner) + origin_m; };
        const rays::ExactTriangle exact{placed(triangle.a), placed(triangle.b), placed(triangle.c)};
        rays::ExactHit hit;
        if (!rays::meets(rays_.along[ray], exact, hit)) return false;
        if (!(hit.t >= rays_.first[ray] && hit.t <= rays_.last)) return false;
        Hit& best = hits_[ray];
        if (std::tie(best.t, best.instance, best.triangle) <= std::tie(hit.t, instance_, triangle.triangle))
            return false;
        const glm::dvec3 normal = glm::cross(exact.b - exact.a, exact.c - exact.a);
        const glm::dvec3 front = item_.mirrored ? -normal : normal;
        const assets::Mesh& mesh = library_.meshes[item_.mesh];
        const bool from_behind = !(glm::dot(front, rays_.along[ray]) < 0.0);
        if (from_behind && !item_.folded && !is_double_sided(library_, mesh, triangle.triangle)) return false;
        if (triangle.mask != rays::kOpaque &&
            !rays::is_there(library_, mesh, triangle.triangle, triangle.mask, hit.weights))
            return false;
        best = {hit.t, instance_, triangle.triangle, front, exact.a};
        t = hit.t;
        return true;
    }

private:
    const assets::MeshLibrary& library_;
    const InstanceItem& item_;
    std::uint32_t instance_;
    const rays::RayPacket& rays_;
    rays::PerLane<Hit>& hits_;
};

math::Aabb bounds_of(const SceneSnapshot& scene) {
    if (has_tree(scene)) return scene.tree.box();
    math::Aabb all;
    for (const InstanceItem& item : scene.instances) all = math::merged(all, item.bounds_ws);
    return all;
}

/// Walk of a packet through the instances.
class Sight {
public:
    Sight(const SceneSnapshot& scene, const visibility::CasterTrees& trees, const rays::RayPacket& rays)
        : scene_(scene), trees_(trees), rays_(rays) {}

    const rays::PerLane<Hit>& look(std::uint32_t& hint) {
        const math::Aabb bounds = bounds_of(scene_);
        if (math::is_empty(bounds)) return hits_;
        const rays::Frame world{glm::dmat3(1.0), math::centre(bounds)};
        const auto boxed = [&](const math::Aabb& box) {
            return rays::Box{glm::vec3(box.min - world.origin_ws_m), glm::vec3(box.max - world.origin_ws_m)};
        };
        rays::cut_to(boxed(bounds), rays::in_frame(rays_, rays_.lanes(), world), rays_.lanes(), open_);
        const auto near = [&](const math::Aabb& box) {
            if (math::is_empty(box)) return Lanes{0};
            const rays::Box part = boxed(box);
            return rays::near_box(open_, part.min, part.max);
        };
        const std::uint32_t first = hint;
        if (first < scene_.instances.size()) enter(first, near(scene_.instances[first].bounds_ws), hint);
        visit_instances(
            scene_,
            [&](const math::Aabb& box) { return near(box) == 0 ? math::Overlap::outside : math::Overlap::partial; },
            [&](std::uint32_t instance) {
                if (instance != first) enter(instance, near(scene_.instances[instance].bounds_ws), hint);
            });
        return hits_;
    }

private:
    void enter(std::uint32_t instance, Lanes near, std::uint32_t& hint) {
        const InstanceItem& item = scene_.instances[instance];
        const rays::MeshBvh* tree = trees_.tree(item.mesh);
        if (near == 0 || !item.visible || !tree) return;
        rays::SegmentPacket segments;
        const rays::Frame frame{item.basis, item.translation_ws_m};
        const Lanes asked = open_.rays_of(near);
        rays::cut_to(tree->box(), rays::in_frame(rays_, asked, frame), asked, segments);
        for (Lanes lanes = segments.lanes; lanes != 0; lanes &= lanes - 1u) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
            segments.shorten(lane, hits_[segments.ray[lane]].t);
        }
        InstanceSight sight(trees_.library(), item, instance, rays_, hits_);
        rays::ask_nearest(*tree, segments, sight);
        for (Lanes lanes = open_.lanes; lanes != 0; lanes &= lanes - 1u) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
            const Hit& hit = hits_[open_.ray[lane]];
            if (hit.instance != instance) continue;
            hint = instance;
            open_.shorten(lane, hit.t);
        }
    }

    const SceneSnapshot& scene_;
    const visibility::CasterTrees& trees_;
    const rays::RayPacket& rays_;
    rays::SegmentPacket open_;  // relative to the middle of the scene
    rays::PerLane<Hit> hits_;
};

void put(const rays::RayPacket& rays, std::size_t ray, const Hit& hit, std::size_t pixel, SeenSurfaces& seen) {
    const double length = glm::length(hit.front);
    if (hit.instance == kNoSurface || !(length > 0.0)) return;
    const glm::dvec3 normal = hit.front / length;
    glm::dvec3 point = rays.along[ray] * hit.t;
    // One Newton step puts the point on the plane to the last bits, even where the ray grazes it.
    point -= normal * glm::dot(normal, point - hit.corner);
    seen.instance[pixel] = hit.instance;
    seen.position_ws_m[pixel] = rays.from[ray] + point;
    seen.normal_ws[pixel] = glm::dot(normal, rays.along[ray]) > 0.0 ? -normal : normal;
}

}  // namespace

void SeenSurfaces::reset(glm::uvec2 size, const glm::dvec3& camera) {
    const std::size_t pixels = std::size_t{size.x} * size.y;
    size_px = size;
    camera_ws_m = camera;
    instance.assign(pixels, kNoSurface);
    position_ws_m.assign(pixels, glm::dvec3(0.0));
    normal_ws.assign(pixels, glm::dvec3(0.0));
}

void SurfaceTracer::trace_row(std::uint32_t row, std::uint32_t& hint, SeenSurfaces& seen) const {
    const std::uint32_t width = seen.size_px.x;
    for (std::uint32_t x = 0; x < width; x += rays::kLanes) {
        rays::RayPacket packet;
        packet.count = std::min<std::size_t>(rays::kLanes, width - x);
        for (std::size_t i = 0; i < packet.count; ++i) {
            const PictureRay ray = picture_ray(camera_, glm::dvec2(static_cast<double>(x + i), row));
            packet.from[i] = ray.from_ws_m;
            packet.along[i] = ray.along;
            packet.first[i] = ray.first;
            packet.last = ray.last;
        }
        const rays::PerLane<Hit> hits = Sight(scene_, trees_, packet).look(hint);
        for (std::size_t i = 0; i < packet.count; ++i) put(packet, i, hits[i], std::size_t{row} * width + x + i, seen);
    }
}

}  // namespace gnomon::truth
