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

/// What a light can reach, were nothing in the way.
class LightReach {
public:
    explicit LightReach(const LightItem& light);

    math::Overlap overlap(const math::Aabb& box) const;
    /// The part of a box that may be reached.
    math::Aabb clipped(const math::Aabb& box) const { return range_m_ ? math::intersection(box, around_) : box; }
    /// Around a spot's cone; of other lights none.
    std::span<const math::Plane> cone() const;

private:
    glm::dvec3 position_ws_m_{0.0};
    std::optional<double> range_m_;
    math::Aabb around_;
    std::optional<std::array<math::Plane, math::kConeSides + 1>> cone_;
};

}  // namespace gnomon::shadow
