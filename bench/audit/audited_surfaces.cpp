#include "bench/audit/audited_surfaces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/oracle/posed_positions.h"

namespace gnomon::bench {

using oracle::PlacedTriangle;

std::array<glm::dvec3, 3> TrueSurfaces::corners_ws_m(const PlacedTriangle& triangle) {
    const InstanceItem& item = scene_.instances[triangle.instance];
    const auto [of_mesh, is_new] = positions_.try_emplace(item.mesh);
    if (is_new) of_mesh->second = oracle::posed_positions(scene_, library_, item.mesh);
    std::array<glm::dvec3, 3> corners;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = library_.meshes[item.mesh].indices[3 * triangle.triangle + i];
        corners[i] = item.basis * of_mesh->second[vertex] + item.translation_ws_m;
    }
    return corners;
}

bool TrueSurfaces::in_one_plane(const PlacedTriangle& a, const PlacedTriangle& b) {
    if (!a.exists() || !b.exists()) return false;
    const std::array<glm::dvec3, 3> of_a = corners_ws_m(a), of_b = corners_ws_m(b);
    const glm::dvec3 normal = glm::normalize(glm::cross(of_b[1] - of_b[0], of_b[2] - of_b[0]));
    const glm::dvec3& camera_ws_m = scene_.consumers.front().position_ws_m;
    return std::all_of(of_a.begin(), of_a.end(), [&](const glm::dvec3& corner) {
        return std::abs(glm::dot(normal, corner - of_b[0])) <= oracle::kJitter * glm::length(corner - camera_ws_m);
    });
}

const std::vector<std::uint32_t>& QueriedSurfaces::slots_of(std::uint32_t mesh) {
    const auto [found, is_new] = slots_.try_emplace(mesh);
    if (!is_new) return found->second;
    const std::span<const rays::BvhTriangle> triangles = trees_.tree(mesh)->triangles();
    for (std::uint32_t slot = 0; slot < triangles.size(); ++slot) {
        if (found->second.size() <= triangles[slot].triangle)
            found->second.resize(triangles[slot].triangle + 1, oracle::kNoTriangle);
        found->second[triangles[slot].triangle] = slot;
    }
    return found->second;
}

glm::dvec3 QueriedSurfaces::on_surface(const PlacedTriangle& triangle, const glm::dvec3& point_ws_m) {
    const InstanceItem& item = scene_.instances[triangle.instance];
    if (!pose_of(scene_, item.mesh) || !trees_.tree(item.mesh)) return point_ws_m;
    const std::vector<std::uint32_t>& slots = slots_of(item.mesh);
    if (triangle.triangle >= slots.size() || slots[triangle.triangle] == oracle::kNoTriangle) return point_ws_m;
    const rays::BvhTriangle& hit = trees_.tree(item.mesh)->triangles()[slots[triangle.triangle]];
    const auto corner = [&](const glm::vec3& p) { return item.basis * glm::dvec3(p) + item.translation_ws_m; };
    const glm::dvec3 a = corner(hit.a);
    const glm::dvec3 normal = glm::normalize(glm::cross(corner(hit.b) - a, corner(hit.c) - a));
    const glm::dvec3 on_plane = point_ws_m - normal * glm::dot(normal, point_ws_m - a);
    return std::isfinite(glm::dot(on_plane, on_plane)) ? on_plane : point_ws_m;
}

}  // namespace gnomon::bench
