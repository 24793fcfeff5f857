#include "systems/truth/seen_surfaces.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "systems/truth/picture_ray.h"
#include "systems/visibility/scene_walk.h"

namespace gnomon::truth {
namespace {

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
class InstanceSight final : public rays::ExactTest {
public:
    InstanceSight(const assets::MeshLibrary& library, const InstanceItem& item, std::uint32_t instance,
                  const rays::RayPacket& rays, rays::PerLane<Hit>& hits)
        : library_(library), item_(item), instance_(instance), rays_(rays), hits_(hits) {}

    bool hits(std::size_t ray, const rays::BvhTriangle& triangle, double& t) override {
        const rays::ExactTriangle exact = visibility::placed(item_, triangle, rays_.from[ray]);
        rays::ExactHit hit;
        if (!rays::meets(rays_.along[ray], exact, hit)) return false;
        if (!(hit.t >= rays_.first[ray] && hit.t <= rays_.last)) return false;
        Hit& best = hits_[ray];
        if (std::tie(best.t, best.instance, best.triangle) <= std::tie(hit.t, instance_, triangle.triangle))
            return false;
        const glm::dvec3 normal = glm::cross(exact.b - exact.a, exact.c - exact.a);
        const glm::dvec3 front = item_.winding.mirrored ? -normal : normal;
        const bool from_behind = !(glm::dot(front, rays_.along[ray]) < 0.0);
        if (from_behind && !item_.winding.folded &&
            !is_double_sided(library_, library_.meshes[item_.mesh], triangle.triangle))
            return false;
        if (!visibility::is_there(library_, item_, triangle, hit)) return false;
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

/// Finds the nearest hit of each ray.
rays::PerLane<Hit> nearest_hits(const SceneSnapshot& scene, const visibility::CasterTrees& trees,
                                const rays::RayPacket& rays, std::uint32_t& hint) {
    const auto is_visible = [](const InstanceItem& item) { return shows_surface(item); };
    rays::PerLane<Hit> hits;
    visibility::SceneWalk walk(scene, trees, rays);
    walk.visit(hint, is_visible, [&](std::uint32_t instance, const rays::MeshBvh& tree, rays::SegmentPacket& segments) {
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(std::popcount(segments.lanes)); ++lane)
            segments.shorten(lane, hits[segments.ray[lane]].t);
        InstanceSight sight(trees.library(), scene.instances[instance], instance, rays, hits);
        rays::nearest_hits(tree, segments, sight);
        for (std::size_t ray = 0; ray < rays.count; ++ray) {
            if (hits[ray].instance != instance) continue;
            hint = instance;
            walk.shorten(ray, hits[ray].t);
        }
    });
    return hits;
}

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

void SurfaceTracer::trace(std::span<const glm::dvec2> at_px, std::size_t first, std::uint32_t& hint,
                          SeenSurfaces& seen) const {
    for (std::size_t done = 0; done < at_px.size(); done += rays::kLanes) {
        rays::RayPacket packet;
        packet.count = std::min<std::size_t>(rays::kLanes, at_px.size() - done);
        for (std::size_t i = 0; i < packet.count; ++i) {
            const PictureRay ray = picture_ray(camera_, at_px[done + i]);
            packet.from[i] = ray.from_ws_m;
            packet.along[i] = ray.along;
            packet.first[i] = ray.first;
            packet.last = ray.last;
        }
        const rays::PerLane<Hit> hits = nearest_hits(scene_, trees_, packet, hint);
        for (std::size_t i = 0; i < packet.count; ++i) put(packet, i, hits[i], first + done + i, seen);
    }
}

void SurfaceTracer::trace_row(std::uint32_t row, std::uint32_t& hint, SeenSurfaces& seen) const {
    std::vector<glm::dvec2> at_px;
    for (std::uint32_t x = 0; x < seen.size_px.x; ++x) at_px.emplace_back(x, row);
    trace(at_px, std::size_t{row} * seen.size_px.x, hint, seen);
}

void SurfaceTracer::trace(std::span<const glm::dvec2> at_px, std::uint32_t& hint, SeenSurfaces& found) const {
    found.reset({at_px.size(), 1}, camera_.position_ws_m);
    trace(at_px, 0, hint, found);
}

double SurfaceTracer::pixel_width_m(const glm::dvec3& at_ws_m) const {
    if (camera_.projection == CameraProjection::orthographic) return pixel_footprint(camera_);
    return pixel_footprint(camera_) * glm::dot(at_ws_m - camera_.position_ws_m, -camera_.rotation_ws[2]);
}

}  // namespace gnomon::truth
