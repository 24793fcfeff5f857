#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/math/aabb.h"
#include "engine/math/frustum.h"
#include "systems/shadow/frame/receiver_caster_sets.h"

namespace gnomon::shadow {

/// What a beam passes between the light and the receivers: the hull of the receivers swept toward the light.
/// A box that touches none of it darkens none of them.
struct SweptVolume {
    /// Edges of the outline, two for each axis of the world, six of what is seen, and the ends.
    static constexpr std::uint32_t kMostPlanes = 32;
    math::Aabb bounds;  // infinite toward a sun
    glm::dvec3 origin_ws_m{0.0};
    double reach_m = 0.0;
    std::array<math::Plane, kMostPlanes> planes;
    std::uint32_t plane_count = 0;
};

/// `polygon`: the beam's outline, or another convex one in its coordinates; not empty. `seen`: planes that all
/// receivers lie within (a camera's), used where the light's side of them is theirs; `slack_m`: how far beyond those a
/// caster may still matter (the filter's width). As seen from the light the test is exact for boxes (separating axes:
/// the outline's edges and those of the box); along the light, and where an outline has more than 18 edges, it is
/// conservative.
SweptVolume swept_volume(const Beam& beam, std::span<const glm::dvec2> polygon, std::span<const math::Plane> seen,
                         double slack_m);

math::Overlap overlap(const SweptVolume& volume, const math::Aabb& box);

}  // namespace gnomon::shadow
