#include "engine/rays/ray_packet.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace gnomon::rays {
namespace {

constexpr double kFloatUnit = 0x1p-24, kDoubleUnit = 0x1p-53;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Share of its longest side by which a box is widened. Rays are cut where they enter and leave the widened box. The
/// cuts then lie so far from all triangles that float can decide.
constexpr double kWider = 1.0 / 64.0;
/// Range of sizes for which products of three coordinates are normal floats.
constexpr double kLeastSize = 1e-9, kMostSize = 1e9;
/// Minimum component of `along`, relative to the coordinates. A smaller one moves no point of [0, 1] beyond the slack;
/// a larger one has a finite inverse.
constexpr float kLeastAlong = 0x1p-30f;
/// Units by which a box is widened. `from` and `along` round by 1 and 2 units of the largest coordinate. A slab's
/// distance rounds by three units of at most three times that. 16 exceeds their sum.
constexpr double kBoxUnits = 16.0;
/// Rounding of an inverse basis times a vector, in units of its condition: the inverse's entries, the products, their
/// sums.
constexpr double kInverseUnits = 64.0;

/// Slack for a share of a segment that rounds to float (2^-24), so that no segment is cut to nothing.
constexpr double kShareSlack = 0x1p-20;

double norm(const glm::dmat3& m) {
    const glm::dvec3 rows = glm::abs(m[0]) + glm::abs(m[1]) + glm::abs(m[2]);
    return std::max({rows.x, rows.y, rows.z});
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Range of t for which a ray is in the box. A NaN, from a ray along a face, cuts nothing.
struct Cut {
    double first, last;
    Cut(const FramedRays& rays, std::size_t ray, const glm::dvec3& low, const glm::dvec3& high)
        : first(rays.first[ray]), last(rays.last) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<glm::length_t>(axis);
            const double from = rays.from[axis][ray], inverse = rays.inverse[axis][ray];
            const double one = (low[i] - from) * inverse, other = (high[i] - from) * inverse;
            first = std::max(first, inverse < 0.0 ? other : one);
            last = std::min(last, inverse < 0.0 ? one : other);
        }
    }
};

void put(const FramedRays& rays, const Cut& cut, std::size_t ray, float least, SegmentPacket& segments,
         std::size_t lane) {
    float largest_along = 0.0f;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double along = rays.along[axis][ray];
        const auto length = static_cast<float>((cut.last - cut.first) * along);
        const float size = std::max(std::abs(length), least);
        const float kept = std::copysign(size, length);
        segments.from[axis][lane] = static_cast<float>(rays.from[axis][ray] + cut.first * along);
        segments.along[axis][lane] = kept;
        segments.inverse[axis][lane] = 1.0f / kept;
        largest_along = std::max(largest_along, size);
    }
    segments.size[lane] = largest_along;
    segments.begin[lane] = cut.first;
    segments.length[lane] = cut.last - cut.first;
}

/// Fills a lane that has no segment, or a segment beyond float, with arbitrary numbers.
void put_unknown(SegmentPacket& segments, std::size_t lane) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        segments.from[axis][lane] = 0.0f;
        segments.along[axis][lane] = segments.inverse[axis][lane] = 1.0f;
    }
    segments.size[lane] = 1.0f;
    segments.begin[lane] = segments.length[lane] = 0.0;
}

}  // namespace

FramedRays in_frame(const RayPacket& rays, Lanes wanted, const Frame& frame) {
    FramedRays framed;
    framed.last = rays.last;
    framed.rays = wanted;
    const glm::dmat3 inverse = glm::inverse(frame.basis);
    double farthest_m = 0.0;
    for (; wanted != 0; wanted &= wanted - 1u) {
        const auto ray = static_cast<std::size_t>(std::countr_zero(wanted));
        const glm::dvec3 from_m = rays.from[ray] - frame.origin_ws_m;
        const glm::dvec3 from = inverse * from_m, along = inverse * rays.along[ray];
        farthest_m = std::max(farthest_m, largest(from_m));
        framed.first[ray] = rays.first[ray];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<glm::length_t>(axis);
            framed.from[axis][ray] = from[i];
            framed.along[axis][ray] = along[i];
            framed.inverse[axis][ray] = 1.0 / along[i];
        }
    }
    const double inverse_norm = norm(inverse);
    framed.largest = inverse_norm * farthest_m;
    framed.rounding = kInverseUnits * kDoubleUnit * inverse_norm * norm(frame.basis);
    return framed;
}

void SegmentPacket::drop(Lanes dropped) {
    lanes &= ~dropped;
    for (; dropped != 0; dropped &= dropped - 1u) last[static_cast<std::size_t>(std::countr_zero(dropped))] = -1.0f;
}

void SegmentPacket::shorten(std::size_t lane, double t) {
    if (!(length[lane] > 0.0)) return;
    const double share = std::clamp((t - begin[lane]) / length[lane], 0.0, 1.0) + kShareSlack;
    last[lane] = std::min(last[lane], static_cast<float>(share));
}

Lanes SegmentPacket::rays_of(Lanes of) const {
    Lanes rays = 0;
    for (; of != 0; of &= of - 1u) rays |= 1u << ray[static_cast<std::size_t>(std::countr_zero(of))];
    return rays;
}

void cut_to(const Box& box, const FramedRays& rays, Lanes wanted, SegmentPacket& segments) {
    segments.lanes = 0;
    if (is_empty(box)) return;
    const glm::dvec3 min(box.min), max(box.max);
    const double rounding = rays.rounding * std::max(rays.largest, std::max(largest(min), largest(max)));
    const glm::dvec3 wider(kWider * largest(max - min) + rounding);
    const glm::dvec3 low = min - wider, high = max + wider;
    const double size = std::max(largest(low), largest(high));
    const bool known = size > kLeastSize && size < kMostSize && std::isfinite(rounding);
    const float least = static_cast<float>(size) * kLeastAlong;
    std::size_t count = 0;
    for (Lanes open = wanted & rays.rays; open != 0; open &= open - 1u) {
        const auto ray = static_cast<std::size_t>(std::countr_zero(open));
        const Cut cut(rays, ray, low, high);
        if (known && !(cut.first <= cut.last)) continue;
        if (known)
            put(rays, cut, ray, least, segments, count);
        else
            put_unknown(segments, count);
        segments.ray[count++] = static_cast<std::uint8_t>(ray);
    }
    segments.lanes = (1u << count) - 1u;
    segments.last.fill(-1.0f);
    std::fill_n(segments.last.begin(), count, 1.0f);
    for (std::size_t lane = count; lane % kVectorLanes != 0; ++lane) put_unknown(segments, lane);
    segments.rounding = static_cast<float>(known ? kFloatUnit * size + rounding : kInfinity);
    segments.box_slack = static_cast<float>(kBoxUnits) * segments.rounding;
}

}  // namespace gnomon::rays
