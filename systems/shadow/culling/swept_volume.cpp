#include "systems/shadow/culling/swept_volume.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "engine/math/cone.h"

namespace gnomon::shadow {
namespace {

/// Largest number of edges: as many as kMostPlanes has room for. A polygon with more loses its shortest ones, which
/// enlarges the volume a little. The hull of 4 boxes has 8 to 12, widening adds 4.
constexpr std::size_t kMostEdges = 18;
/// Length of the shortest edge that counts, in slacks of the hull. Widening by two slacks makes edges of at most 4 √2
/// from a corner, with a direction that is mere rounding.
constexpr double kShortestEdge = 8.0;
/// Ratio of squared lengths above which edges count as equally long, as those of widened corners are. The first of
/// equal edges are used.
constexpr double kAsLong = 1.0 - 1.0 / (1 << 20);
/// Relative error of coordinates, a few of their last bits; see kRounding in engine/math/frustum.cpp.
constexpr double kRounding = 0x1p-48;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

class Builder {
public:
    Builder(const ReceiverHull& receiver_hull, std::span<const glm::dvec2> polygon)
        : receiver_hull_(receiver_hull), polygon_(polygon) {
        volume_.origin_ws_m = receiver_hull.origin_ws_m;
        volume_.reach_m = receiver_hull.reach_m;
    }

    SweptVolume build(std::span<const math::Plane> seen, double slack_m) {
        bound();
        add_edges();
        for (int axis = 0; axis < 3; ++axis) add_world_axis(axis);
        // From the farthest receiver toward the light, and from the light on.
        add(receiver_hull_.axes[2],
            receiver_hull_.far_m - glm::dot(receiver_hull_.axes[2], receiver_hull_.origin_ws_m));
        if (!receiver_hull_.parallel)
            add(-receiver_hull_.axes[2], glm::dot(receiver_hull_.axes[2], receiver_hull_.origin_ws_m));
        for (const math::Plane& plane : seen) add_seen(plane, slack_m);
        return volume_;
    }

private:
    void add(const glm::dvec3& normal, double offset) {
        if (volume_.plane_count < SweptVolume::kMostPlanes) volume_.planes[volume_.plane_count++] = {normal, offset};
    }

    /// Adds the plane along the light's rays that touches the polygon: dot(normal, p) >= least for its points p.
    void add_line(const glm::dvec2& normal) {
        double least = kInfinity;
        for (const glm::dvec2& p : polygon_) least = std::min(least, glm::dot(normal, p));
        const glm::dvec3 across = receiver_hull_.axes[0] * normal.x + receiver_hull_.axes[1] * normal.y;
        if (receiver_hull_.parallel) {
            add(across, -least - glm::dot(across, receiver_hull_.origin_ws_m));
        } else {
            const glm::dvec3 through_light = across + receiver_hull_.axes[2] * least;
            add(through_light, -glm::dot(through_light, receiver_hull_.origin_ws_m));
        }
    }

    void add_edges() {
        const auto edge = [&](std::size_t i) { return polygon_[(i + 1) % polygon_.size()] - polygon_[i]; };
        // Squared length of the shortest edge that counts.
        double least = kShortestEdge * kShortestEdge * receiver_hull_.slack * receiver_hull_.slack;
        if (polygon_.size() > kMostEdges) {
            std::array<double, kMostEdges> longest{};
            for (std::size_t i = 0; i < polygon_.size(); ++i) {
                const double length = glm::dot(edge(i), edge(i));
                const auto smallest = std::min_element(longest.begin(), longest.end());
                *smallest = std::max(*smallest, length);
            }
            least = std::max(least, kAsLong * *std::min_element(longest.begin(), longest.end()));
        }
        std::size_t edges = 0;
        for (std::size_t i = 0; i < polygon_.size() && edges < kMostEdges; ++i) {
            const glm::dvec2 along = edge(i);
            if (!(glm::dot(along, along) >= least) || along == glm::dvec2(0.0)) continue;
            add_line({-along.y, along.x});
            ++edges;
        }
        if (polygon_.size() > 2 && edges > 0) return;  // a point or a line has no sides
        for (const glm::dvec2 normal : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)})
            add_line(normal);
    }

    void add_world_axis(int axis) {
        if (receiver_hull_.parallel)
            add_slab(axis);
        else
            add_pencil(axis);
    }

    /// Adds the two planes around the polygon that contain a world axis and the direction of parallel light.
    void add_slab(int axis) {
        glm::dvec3 edge(0.0);
        edge[axis] = 1.0;
        const glm::dvec3 across = glm::cross(edge, receiver_hull_.axes[2]);
        const glm::dvec2 normal(glm::dot(across, receiver_hull_.axes[0]), glm::dot(across, receiver_hull_.axes[1]));
        add_line(normal);
        add_line(-normal);
    }

    /// Adds the two planes around the polygon that contain a world axis and the position of the light, if there are
    /// any.
    void add_pencil(int axis) {
        const int first = (axis + 1) % 3, second = (axis + 2) % 3;
        const auto ray = [&](const glm::dvec2& p) {
            const glm::dvec3 r = receiver_hull_.axes[0] * p.x + receiver_hull_.axes[1] * p.y - receiver_hull_.axes[2];
            return glm::dvec2(r[first], r[second]);
        };
        glm::dvec2 low = ray(polygon_.front()), high = low;
        for (const glm::dvec2& p : polygon_) {
            const glm::dvec2 r = ray(p);
            if (cross(low, r) < 0.0) low = r;
            if (cross(high, r) > 0.0) high = r;
        }
        // If the axis itself, forward or back, lies in the polygon, rays go all around it.
        for (const glm::dvec2& p : polygon_) {
            const glm::dvec2 r = ray(p);
            const double slack = kRounding * (std::abs(r.x) + std::abs(r.y));
            if (cross(low, r) < -slack * (std::abs(low.x) + std::abs(low.y)) ||
                cross(high, r) > slack * (std::abs(high.x) + std::abs(high.y)))
                return;
        }
        const auto add_half = [&](const glm::dvec2& inward) {
            glm::dvec3 normal(0.0);
            normal[first] = inward.x;
            normal[second] = inward.y;
            add(normal, -glm::dot(normal, receiver_hull_.origin_ws_m));
        };
        add_half({-low.y, low.x});
        add_half({high.y, -high.x});
    }

    void add_seen(const math::Plane& plane, double slack_m) {
        const double toward_light = receiver_hull_.parallel
                                        ? glm::dot(plane.normal, receiver_hull_.axes[2])
                                        : glm::dot(plane.normal, receiver_hull_.origin_ws_m) + plane.offset;
        if (toward_light >= 0.0) add(plane.normal, plane.offset + slack_m * glm::length(plane.normal));
    }

    /// Computes the bounding box of the light and the polygon at the far end.
    void bound() {
        math::Aabb& bounds = volume_.bounds;
        if (!receiver_hull_.parallel) bounds = math::extended(bounds, receiver_hull_.origin_ws_m);
        for (const glm::dvec2& p : polygon_) {
            const glm::dvec3 across = receiver_hull_.axes[0] * p.x + receiver_hull_.axes[1] * p.y;
            const glm::dvec3 offset = receiver_hull_.parallel
                                          ? across - receiver_hull_.axes[2] * receiver_hull_.far_m
                                          : (across - receiver_hull_.axes[2]) * receiver_hull_.far_m;
            bounds = math::extended(bounds, receiver_hull_.origin_ws_m + offset);
        }
        const glm::dvec3 slack = kRounding * glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
        bounds.min -= slack;
        bounds.max += slack;
        if (!receiver_hull_.parallel) return;
        for (int axis = 0; axis < 3; ++axis) {
            if (receiver_hull_.axes[2][axis] > 0.0) bounds.max[axis] = kInfinity;
            if (receiver_hull_.axes[2][axis] < 0.0) bounds.min[axis] = -kInfinity;
        }
    }

    const ReceiverHull& receiver_hull_;
    std::span<const glm::dvec2> polygon_;
    SweptVolume volume_;
};

/// Bits of the tests beside those of the planes.
constexpr math::OpenTests kBoundsTest = math::OpenTests{1} << SweptVolume::kMostPlanes, kBallTest = kBoundsTest << 1;

bool holds(const math::Aabb& outer, const math::Aabb& inner) {
    return glm::all(glm::lessThanEqual(outer.min, inner.min)) && glm::all(glm::lessThanEqual(inner.max, outer.max));
}

math::Overlap both(math::Overlap a, math::Overlap b) {
    if (a == math::Overlap::outside || b == math::Overlap::outside) return math::Overlap::outside;
    return a == b ? a : math::Overlap::partial;
}

}  // namespace

SweptVolume swept_volume(const ReceiverHull& receiver_hull, std::span<const glm::dvec2> polygon,
                         std::span<const math::Plane> seen, double slack_m) {
    return Builder(receiver_hull, polygon).build(seen, slack_m);
}

math::Overlap overlap(const SweptVolume& volume, const math::Aabb& box) {
    if (!math::overlaps(volume.bounds, box)) return math::Overlap::outside;
    math::Overlap planes = math::overlap({volume.planes.data(), volume.plane_count}, box);
    if (planes == math::Overlap::inside && !holds(volume.bounds, box)) planes = math::Overlap::partial;
    if (planes == math::Overlap::outside || !std::isfinite(volume.reach_m)) return planes;
    return both(planes, math::overlap_ball(volume.origin_ws_m, volume.reach_m, box));
}

math::OpenTests tests_of(const SweptVolume& volume) {
    return math::open_tests(volume.plane_count) | kBoundsTest | (std::isfinite(volume.reach_m) ? kBallTest : 0);
}

math::Overlap overlap(const SweptVolume& volume, const math::Aabb& box, math::OpenTests& open) {
    if ((open & kBoundsTest) != 0 && !math::overlaps(volume.bounds, box)) return math::Overlap::outside;
    math::Overlap result = math::overlap({volume.planes.data(), volume.plane_count}, box, open);
    if (result == math::Overlap::outside) return result;
    if ((open & kBoundsTest) != 0) {
        if (holds(volume.bounds, box))
            open &= ~kBoundsTest;
        else
            result = math::Overlap::partial;
    }
    if ((open & kBallTest) == 0) return result;
    const math::Overlap ball = math::overlap_ball(volume.origin_ws_m, volume.reach_m, box);
    if (ball == math::Overlap::inside) open &= ~kBallTest;
    return both(result, ball);
}

}  // namespace gnomon::shadow
