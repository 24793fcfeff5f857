#include "systems/embed/light_orientation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/math/finite.h"
#include "engine/math/frustum.h"
#include "engine/math/projection.h"

namespace gnomon::embed {

std::optional<glm::dmat3> orientation_of(const LightDesc& desc) {
    const glm::dvec3& along = desc.direction;
    const double size = std::max({std::abs(along.x), std::abs(along.y), std::abs(along.z)});
    if (!math::is_finite(along) || !(size > 0.0)) return std::nullopt;
    const glm::dmat3 axes = math::basis_from_back(-glm::normalize(along / size));
    const glm::dvec3& back = axes[2];
    const glm::dvec3 across = desc.right - back * glm::dot(desc.right, back);
    const double length = glm::length(across);
    constexpr double kLeastShare = 1.0e-9;  // below it rounding alone would choose the way
    if (!std::isfinite(length) || !(length > kLeastShare * glm::length(desc.right))) return axes;
    return glm::dmat3(across / length, glm::cross(back, across / length), back);
}

}  // namespace gnomon::embed
