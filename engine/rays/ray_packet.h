#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "engine/rays/bvh.h"

/// Rays sixteen at a time: those near each other share the way through a tree.
namespace gnomon::rays {

inline constexpr std::size_t kLanes = 16, kVectorLanes = 4;
using Lanes = std::uint32_t;  // a bit per lane
inline constexpr Lanes kAllLanes = (1u << kLanes) - 1u;

template <class Number>
using PerLane = std::array<Number, kLanes>;

/// from + t * along for t in (first, last). In double, in the world; all finite but `last`, which is infinite for rays
/// without an end.
struct RayPacket {
    PerLane<glm::dvec3> from{}, along{};
    PerLane<double> first{};  // at least 0
    double last = 1.0;
    std::size_t count = 0;  // the other lanes are none
    Lanes lanes() const { return (1u << count) - 1u; }
};

/// p_ws = basis * p + origin.
struct Frame {
    glm::dmat3 basis{1.0};
    glm::dvec3 origin_ws_m{0.0};
    bool operator==(const Frame&) const = default;
};

/// The rays of a packet in a frame's space, in double.
struct FramedRays {
    std::array<PerLane<double>, 3> from, along, inverse;  // inverse: 1 / along
    PerLane<double> first;
    double last = 1.0;
    double largest = 0.0;   // coordinate of where rays begin
    double rounding = 0.0;  // relative to `largest`, of all coordinates; not finite if the frame has no inverse
    Lanes rays = 0;         // those that are here
};

FramedRays in_frame(const RayPacket& rays, Lanes wanted, const Frame& frame);

/// The parts of rays that lie near a box, in its space and in float: from + t * along, t in [0, 1]. How far these can
/// be from the rays in double, and whatever is computed of them, is bounded (ray_packet.cpp): what a walk says of them
/// for sure holds for the rays. They fill the first lanes, so that a few cost less than many.
struct SegmentPacket {
    alignas(64) std::array<PerLane<float>, 3> from, along, inverse;
    alignas(64) PerLane<float> last;  // 1, or less once it is shortened; below 0: the lane is none
    alignas(64) PerLane<float> size;  // largest component of along
    PerLane<std::uint8_t> ray;        // which of the packet's each lane holds
    PerLane<double> begin, length;    // the ray's own t where a lane's is 0, and from there to 1; length 0: not known
    float box_slack = 0.0f;           // by which boxes are widened; infinite: float knows nothing
    float rounding = 0.0f;            // of coordinates; infinite as well
    Lanes lanes = 0;

    void drop(Lanes dropped);
    /// What lies beyond `t` of the lane's ray is of no interest any more: boxes there are no longer near.
    void shorten(std::size_t lane, double t);
    Lanes rays_of(Lanes of) const;  // a bit per ray of the packet
};

/// The `wanted` rays near the box, which is of the rays' space; others are left out.
void cut_to(const Box& box, const FramedRays& rays, Lanes wanted, SegmentPacket& segments);

}  // namespace gnomon::rays
