#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/math/aabb.h"
#include "engine/math/frustum.h"
#include "systems/shadow/frame/receiver_caster_sets.h"

namespace gnomon::shadow {

/// Receiver hull swept toward the light. A box outside of it cannot darken any of the receivers.
struct SweptVolume {
    /// Edges of the polygon, two planes for each world axis, six of the camera's frustum, and both ends.
    static constexpr std::uint32_t kMostPlanes = 32;
    math::Aabb bounds;  // infinite toward a sun
    glm::dvec3 origin_ws_m{0.0};
    double reach_m = 0.0;
    std::array<math::Plane, kMostPlanes> planes;
    std::uint32_t plane_count = 0;
};

/// Computes the swept volume of a receiver hull. In light space the test is exact for boxes, by separating axes: edges
/// of the polygon and of the box. Along the light, and for polygons with more than 18 edges, it is conservative.
/// `polygon`: the hull's own, or another convex one in its coordinates; not empty. `seen`: planes of a camera that
/// contain all receivers. A plane is used where the light is on the receivers' side of it. `slack_m`: distance beyond
/// the planes at which casters still count, because of the filter's width.
SweptVolume swept_volume(const ReceiverHull& receiver_hull, std::span<const glm::dvec2> polygon,
                         std::span<const math::Plane> seen, double slack_m);

/// Classifies a box against the volume.
math::Overlap overlap(const SweptVolume& volume, const math::Aabb& box);

/// Does the same with the tests in `open`, and clears the tests that no box within this one needs (math::OpenTests).
math::Overlap overlap(const SweptVolume& volume, const math::Aabb& box, math::OpenTests& open);
/// Returns all tests of the volume: its planes, its bounds and its ball.
math::OpenTests tests_of(const SweptVolume& volume);

}  // namespace gnomon::shadow
