#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/mesh/mesh_topology.h"

namespace gnomon::assets {
namespace {

/// Computes the angle at `corner` between the other two, well conditioned near 0 and pi.
double angle_at(const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 to_a = a - corner;
    const glm::dvec3 to_b = b - corner;
    return std::atan2(glm::length(glm::cross(to_a, to_b)), glm::dot(to_a, to_b));
}

/// Length below which a sum of weighted normals is rounding noise of opposite faces, relative to the sum of weights.
/// 2^-53 per addition, for up to a thousand faces at a vertex.
constexpr double kCancelled = 1e-13;

}  // namespace

void fill_normals(Mesh& mesh, const std::vector<bool>& missing) {
    std::vector<glm::dvec3> sums(mesh.vertices.size(), glm::dvec3(0.0));
    std::vector<double> angles_rad(mesh.vertices.size(), 0.0);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        glm::dvec3 corners[3];
        for (std::size_t c = 0; c < 3; ++c) corners[c] = mesh.vertices[mesh.indices[i + c]].position_ms;
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double length = glm::length(normal);
        if (!(length > 0.0)) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const double angle_rad = angle_at(corners[c], corners[(c + 1) % 3], corners[(c + 2) % 3]);
            sums[mesh.indices[i + c]] += normal / length * angle_rad;
            angles_rad[mesh.indices[i + c]] += angle_rad;
        }
    }
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (v >= missing.size() || !missing[v]) continue;
        const double length = glm::length(sums[v]);
        const bool has_normal = length > kCancelled * angles_rad[v];
        mesh.vertices[v].normal_ms = has_normal ? glm::vec3(sums[v] / length) : glm::vec3(0.0f);
    }
}

}  // namespace gnomon::assets
