#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/assets/gltf_limits.h"
#include "engine/assets/gltf_mesh.h"
#include "engine/math/aabb.h"

namespace gnomon::assets::gltf {
namespace {

double largest_of(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Returns the middle of a range, rounded to a step of its floats; 0 if the range is longer than its distance from 0.
/// Differences to it are then exact in float (Sterbenz): both numbers are within a factor of two on the same side of 0.
double middle_of(double least, double most) {
    const double nearest = std::min(std::abs(least), std::abs(most)),
                 farthest = std::max(std::abs(least), std::abs(most));
    const bool one_side = (least > 0.0) == (most > 0.0);
    if (!(one_side && nearest >= 0.5 * farthest)) return 0.0;
    const auto at = static_cast<float>(farthest);
    const double step = static_cast<double>(at) - static_cast<double>(std::nextafter(at, 0.0f));
    return step > 0.0 ? step * std::round((0.5 * least + 0.5 * most) / step) : 0.0;
}

}  // namespace

MeshPlace near_origin(Mesh& mesh) {
    math::Aabb bounds;
    std::vector<bool> used(mesh.vertices.size(), false);
    for (const std::uint32_t vertex : mesh.indices) {
        const glm::dvec3 position{mesh.vertices[vertex].position_ms};
        bounds.min = glm::min(bounds.min, position);
        bounds.max = glm::max(bounds.max, position);
        used[vertex] = true;
    }
    MeshPlace place;
    if (math::is_empty(bounds)) return place;
    const double farthest = std::max(largest_of(bounds.min), largest_of(bounds.max));
    if (farthest <= static_cast<double>(kMaxPosition_ms)) return place;
    for (int i = 0; i < 3; ++i) place.middle_m[i] = middle_of(bounds.min[i], bounds.max[i]);
    const double reach = std::max(largest_of(bounds.min - place.middle_m), largest_of(bounds.max - place.middle_m));
    while (reach > place.scale * static_cast<double>(kMaxPosition_ms)) place.scale *= 2.0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        glm::vec3& position = mesh.vertices[i].position_ms;
        position = used[i] ? glm::vec3((glm::dvec3(position) - place.middle_m) / place.scale) : glm::vec3(0.0f);
    }
    return place;
}

}  // namespace gnomon::assets::gltf
