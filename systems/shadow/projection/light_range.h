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

/// Returns the half-space into which a light shines that does so from one side of its plane.
math::Plane shone_side(const LightItem& light);

/// Volume that a light can reach without occluders: its range, and a spot's cone or the side of its plane.
class LightReach {
public:
    explicit LightReach(const LightItem& light);

    /// Classifies a box against the volume. Conservative: `inside` only if the volume is unlimited.
    math::Overlap overlap(const math::Aabb& box) const;
    /// Does the same with the tests in `open`, and clears the tests that no box within this one needs. `inside`:
    /// it needs none.
    math::Overlap overlap(const math::Aabb& box, math::OpenTests& open) const;
    /// Returns all tests of the volume.
    math::OpenTests tests() const;
    /// Returns the part of a box within the range's bounding box.
    math::Aabb clipped(const math::Aabb& box) const { return range_m_ ? math::intersection(box, around_) : box; }
    /// Returns the range's bounding box; infinite for an unlimited one.
    math::Aabb bounds() const { return range_m_ ? around_ : math::kEverywhere; }
    /// Returns planes around a spot's cone, or the plane before which a light shines from one side; none for others.
    std::span<const math::Plane> cone() const;

private:
    glm::dvec3 position_ws_m_{0.0};
    std::optional<double> range_m_;
    math::Aabb around_;
    std::optional<std::array<math::Plane, math::kConeSides + 1>> cone_;
    std::optional<math::Plane> side_;  // where the light shines from one side of its plane
};

/// What a camera sees and a light reaches, for searches of a tree with tests that parts inherit.
class SeenReach {
public:
    /// Refers to both.
    SeenReach(std::span<const math::Plane> seen, const LightReach& reach) : seen_(seen), reach_(reach) {}

    /// Classifies a box against both, as LightReach::overlap().
    math::Overlap overlap(const math::Aabb& box, math::OpenTests& open) const {
        math::OpenTests of_camera = open & math::open_tests(kOfCamera), of_light = open >> kOfCamera;
        const math::Overlap seen = math::overlap(seen_, box, of_camera);
        if (seen == math::Overlap::outside) return seen;
        const math::Overlap reached = reach_.overlap(box, of_light);
        open = of_camera | of_light << kOfCamera;
        return reached == math::Overlap::inside ? seen : reached;
    }
    math::OpenTests tests() const { return math::open_tests(seen_.size()) | reach_.tests() << kOfCamera; }

private:
    static constexpr std::size_t kOfCamera = 8;  // bits of a frustum's planes, at most 6
    std::span<const math::Plane> seen_;
    const LightReach& reach_;
};

}  // namespace gnomon::shadow
