#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "engine/rays/bvh.h"

/// Rays in packets of sixteen: neighbouring rays share the walk through a tree.
namespace gnomon::rays {

inline constexpr std::size_t kLanes = 16, kVectorLanes = 4;
using Lanes = std::uint32_t;  // a bit per lane
inline constexpr Lanes kAllLanes = (1u << kLanes) - 1u;

template <class Number>
using PerLane = std::array<Number, kLanes>;

/// Rays from + t * along for t in (first, last), in double, in world space. All numbers are finite except `last`:
/// infinite for rays without an end.
struct RayPacket {
    PerLane<glm::dvec3> from{}, along{};
    PerLane<double> first{};  // >= 0
    double last = 1.0;
    std::size_t count = 0;  // lanes from `count` on are unused
    Lanes lanes() const { return (1u << count) - 1u; }
};

/// Frame of reference: p_ws = basis * p + origin.
struct Frame {
    glm::dmat3 basis{1.0};
    glm::dvec3 origin_ws_m{0.0};
    bool operator==(const Frame&) const = default;
};

/// Rays of a packet in a frame's space, in double.
struct FramedRays {
    std::array<PerLane<double>, 3> from, along, inverse;  // inverse: 1 / along
    PerLane<double> first;
    double last = 1.0;
    double largest = 0.0;   // largest coordinate of the rays' origins
    double rounding = 0.0;  // relative to `largest`, of all coordinates; not finite if the frame has no inverse
    Lanes rays = 0;         // rays present, a bit each
};

FramedRays in_frame(const RayPacket& rays, Lanes wanted, const Frame& frame);

/// Segments of rays near a box, in its space and in float: from + t * along, t in [0, 1]. Their distance from the rays
/// in double, and all rounding, is bounded (ray_packet.cpp). What a walk decides for certain about a segment thus holds
/// for its ray. Segments fill the first lanes, so that few cost less than many.
struct SegmentPacket {
    alignas(64) std::array<PerLane<float>, 3> from, along, inverse;
    alignas(64) PerLane<float> last;  // 1, or less once shortened; < 0: unused lane
    alignas(64) PerLane<float> size;  // largest component of along
    PerLane<std::uint8_t> ray;        // index of the lane's ray in the packet
    PerLane<double> begin, length;    // the ray's own t at a lane's 0, and from there to its 1; length 0: unknown
    float box_slack = 0.0f;           // boxes are widened by this; infinite: float decides nothing
    float rounding = 0.0f;            // rounding of coordinates; infinite: float decides nothing
    Lanes lanes = 0;

    void drop(Lanes dropped);
    /// Shortens the lane's segment to `t` of its ray: boxes beyond are then not near.
    void shorten(std::size_t lane, double t);
    Lanes rays_of(Lanes of) const;  // a bit per ray of the packet
};

/// Cuts the `wanted` rays to the box, which is in the rays' space; drops rays that are not near it.
void cut_to(const Box& box, const FramedRays& rays, Lanes wanted, SegmentPacket& segments);

}  // namespace gnomon::rays
