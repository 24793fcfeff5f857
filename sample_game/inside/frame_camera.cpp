#include "sample_game/inside/frame_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>

#include "engine/math/aabb.h"
#include "engine/rays/exact_triangle.h"
#include "systems/extract/drawable_basis.h"

namespace gnomon::game {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNearPerSize = 1.0e-4;  // near plane, of the half diagonal: reversed depth does not care how small
constexpr double kOutsideFov_rad = 0.8, kInsideFov_rad = 1.15;
constexpr double kAspect = 16.0 / 9.0;

struct Hit {
    double distance = kInfinity;
    bool front = false;  // the face is turned toward the ray's origin, or seen from both sides
};

/// Updates the nearest hit of a ray with `mesh`, in the mesh's own space.
void cast_at_mesh(const assets::Mesh& mesh, const assets::SceneData& scene, const glm::dvec3& origin,
                  const glm::dvec3& direction, Hit& nearest) {
    const auto corner = [&](std::uint32_t index) {
        return glm::dvec3(mesh.vertices[mesh.indices[index]].position_ms) - origin;
    };
    for (const assets::Submesh& part : mesh.submeshes) {
        const bool two_sided = scene.materials[part.material].double_sided;
        for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3) {
            const rays::ExactTriangle triangle{corner(i), corner(i + 1), corner(i + 2)};
            rays::ExactHit hit;
            if (!rays::meets(direction, triangle, hit) || !(hit.t > 0.0 && hit.t < nearest.distance)) continue;
            nearest = {hit.t, two_sided || rays::begins_before(triangle)};
        }
    }
}

/// Casts rays against the plain triangle list. Three dozen of them cost less than building a tree.
class RayCaster {
public:
    RayCaster(const assets::SceneData& scene, const std::vector<WorldTransform>& poses)
        : scene_(scene), poses_(poses) {}

    Hit cast(const glm::dvec3& origin_ws, const glm::dvec3& direction_ws) const {
        Hit nearest;
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            const assets::Node& node = scene_.nodes[i];
            const std::optional<glm::dmat3> basis = drawable_basis(poses_[i].basis);
            if (node.mesh == assets::kNone || !node.visible || !basis) continue;
            const assets::Mesh& mesh = scene_.meshes[static_cast<std::size_t>(node.mesh)];
            if (mesh.deformer) continue;  // a figure in a room is none of its walls
            const glm::dmat3 model_from_world = glm::inverse(*basis);
            const glm::dvec3 origin = model_from_world * (origin_ws - poses_[i].translation_ws_m);
            const glm::dvec3 direction = model_from_world * direction_ws;  // not normalised: t stays in metres
            if (!reaches(mesh.bounds_ms, origin, direction, nearest.distance)) continue;
            Hit hit{nearest.distance, false};
            cast_at_mesh(mesh, scene_, origin, direction, hit);
            if (!(hit.distance < nearest.distance)) continue;
            nearest = hit;
        }
        return nearest;
    }

private:
    static bool reaches(const math::Aabb& box, const glm::dvec3& origin, const glm::dvec3& direction, double far) {
        double near = 0.0;
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const double a = (box.min[axis] - origin[axis]) / direction[axis];
            const double b = (box.max[axis] - origin[axis]) / direction[axis];
            if (std::isnan(a) || std::isnan(b)) continue;  // parallel and on the face: leave it to the triangles
            near = std::max(near, std::min(a, b));
            far = std::min(far, std::max(a, b));
        }
        return near <= far;
    }

    const assets::SceneData& scene_;
    const std::vector<WorldTransform>& poses_;
};

glm::dvec3 direction_at(double azimuth_rad, double elevation_rad) {
    return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::sin(elevation_rad),
            std::cos(elevation_rad) * std::sin(azimuth_rad)};
}

glm::dquat looking_along(const glm::dvec3& forward) {
    const glm::dvec3 back = -glm::normalize(forward);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), back));
    return glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)));
}

bool is_interior(const RayCaster& rays, const glm::dvec3& centre) {
    constexpr int kAzimuths = 16;
    constexpr double kElevations_rad[] = {0.0, 0.45};
    constexpr double kSurrounded = 0.85;
    int hits = 0, cast = 0;
    for (const double elevation : kElevations_rad) {
        for (int i = 0; i < kAzimuths; ++i, ++cast) {
            // Half a step off, so that no ray runs along an axis, where models have their seams.
            const double azimuth = 2.0 * glm::pi<double>() * (i + 0.5) / kAzimuths;
            if (rays.cast(centre, direction_at(azimuth, elevation)).front) ++hits;
        }
    }
    return hits >= kSurrounded * cast;
}

FramedCamera from_inside(const RayCaster& rays, const math::Aabb& bounds, double size_m) {
    constexpr double kStandBack = 0.8, kEyeHeight = 0.35;
    const glm::dvec3 centre = math::centre(bounds), half = math::half_extent(bounds);
    const glm::dvec3 axis = half.x >= half.z ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    const double reach = std::max(half.x, half.z);
    const double ahead = std::min(rays.cast(centre, axis).distance, reach);
    const double behind = std::min(rays.cast(centre, -axis).distance, reach);
    const glm::dvec3 away = ahead >= behind ? axis : -axis;
    const double floor = std::min(rays.cast(centre, {0.0, -1.0, 0.0}).distance, half.y);
    const glm::dvec3 target = centre - glm::dvec3(0.0, floor * (1.0 - kEyeHeight), 0.0);
    const glm::dvec3 position = target + away * (kStandBack * std::max(ahead, behind));
    FramedCamera framed;
    framed.transform.translation_m = position;
    framed.transform.rotation = looking_along(-away + glm::dvec3(0.0, 0.15, 0.0));
    framed.camera = {.fov_y_rad = kInsideFov_rad, .near_m = kNearPerSize * size_m, .far_m = kInfinity};
    return framed;
}

FramedCamera from_outside(const math::Aabb& bounds, double size_m) {
    const glm::dvec3 toward = glm::normalize(glm::dvec3(0.62, 0.5, 0.8));
    const glm::dquat rotation = looking_along(-toward);
    const glm::dmat3 axes = glm::mat3_cast(rotation);
    const double tan_y = std::tan(0.5 * kOutsideFov_rad), tan_x = tan_y * kAspect;
    double distance = 0.0;  // the smallest at which every corner is within the pyramid
    for (const glm::dvec3& corner : math::corners(bounds)) {
        const glm::dvec3 d = corner - math::centre(bounds);
        const double x = std::abs(glm::dot(d, axes[0])), y = std::abs(glm::dot(d, axes[1])), z = glm::dot(d, axes[2]);
        distance = std::max({distance, z + x / tan_x, z + y / tan_y});
    }
    constexpr double kMargin = 1.05;
    FramedCamera framed;
    framed.transform.translation_m = math::centre(bounds) + toward * (kMargin * distance);
    framed.transform.rotation = rotation;
    framed.camera = {.fov_y_rad = kOutsideFov_rad, .near_m = kNearPerSize * size_m, .far_m = kInfinity};
    return framed;
}

}  // namespace

FramedCamera frame_scene(const assets::SceneData& scene, const std::vector<WorldTransform>& poses,
                         const math::Aabb& bounds) {
    const double size_m = glm::length(math::half_extent(bounds));
    if (math::is_empty(bounds) || !(size_m > 0.0) || !std::isfinite(size_m)) return {};
    const RayCaster rays(scene, poses);
    return is_interior(rays, math::centre(bounds)) ? from_inside(rays, bounds, size_m) : from_outside(bounds, size_m);
}

}  // namespace gnomon::game
