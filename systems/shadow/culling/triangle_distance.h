#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

using Corners = std::array<glm::dvec3, 3>;  // corners of a triangle, relative to a lamp

/// Returns the distance from the origin to the nearest point of a segment.
inline double distance_to(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double length2 = glm::dot(along, along);
    const double at = length2 > 0.0 ? std::clamp(-glm::dot(a, along) / length2, 0.0, 1.0) : 0.0;
    return glm::length(a + at * along);
}

/// Returns the distance from the origin to the nearest point of a triangle. That is the foot of the perpendicular if it
/// lies inside, otherwise a point on an edge.
inline double distance_to(const Corners& c) {
    const double edges = std::min({distance_to(c[0], c[1]), distance_to(c[1], c[2]), distance_to(c[2], c[0])});
    const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    const double area = glm::length(normal);
    if (!(area > 0.0)) return edges;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 &from = c[i], &to = c[(i + 1) % 3];
        if (glm::dot(glm::cross(to - from, -from), normal) < 0.0) return edges;
    }
    return std::min(edges, std::abs(glm::dot(c[0], normal)) / area);
}

/// Visits the triangles of an instance that cast, with corners relative to `from_ws_m`.
template <class Visit>
void visit_triangles(const GpuScene& gpu, const InstanceItem& item, const glm::dvec3& from_ws_m, const Visit& visit) {
    const GpuScene::MeshShape shape = gpu.shape(item.mesh);
    const GpuScene::MeshRange& mesh = gpu.mesh(item.mesh);
    const auto& indices = *shape.indices;
    const glm::dvec3 origin = item.translation_ws_m - from_ws_m;
    for (std::uint32_t s = 0; s < mesh.submesh_count; ++s) {
        const GpuScene::SubmeshRange& submesh = gpu.submesh(mesh.first_submesh + s);
        if (gpu.material(submesh.material).transmits) continue;
        const std::size_t first = submesh.first_index - mesh.first_index;
        for (std::size_t i = first; i + 2 < first + submesh.index_count; i += 3) {
            Corners c;
            for (std::size_t k = 0; k < 3; ++k)
                c[k] = origin + item.basis * glm::dvec3((*shape.vertices)[indices[i + k]].position_ms);
            visit(c);
        }
    }
}

}  // namespace gnomon::shadow
