#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "engine/math/aabb.h"
#include "engine/math/cone.h"
#include "engine/math/frustum.h"
#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

/// Volume that a light can reach without occluders: its range, and a spot's cone.
class LightReach {
public:
    explicit LightReach(const LightItem& light);

    /// Classifies a box against the volume. Conservative: `inside` only if the volume is unlimited.
    math::Overlap overlap(const math::Aabb& box) const;
    /// Returns the part of a box within the range's bounding box.
    math::Aabb clipped(const math::Aabb& box) const { return range_m_ ? math::intersection(box, around_) : box; }
    /// Returns the range's bounding box; infinite for an unlimited one.
    math::Aabb bounds() const { return range_m_ ? around_ : math::kEverywhere; }
    /// Returns planes around a spot's cone; none for other lights.
    std::span<const math::Plane> cone() const;

private:
    glm::dvec3 position_ws_m_{0.0};
    std::optional<double> range_m_;
    math::Aabb around_;
    std::optional<std::array<math::Plane, math::kConeSides + 1>> cone_;
};

}  // namespace gnomon::shadow
