#include "engine/math/frustum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "engine/math/finite.h"

namespace gnomon::math {
namespace {

// Rounding of dot(normal, p) + offset relative to the sum of its terms' sizes. The evaluation takes at most 4 units in
// the last place (2^-53). A point at the crossing of two well-conditioned planes adds a few; 16 units cover both.
// Tested by ClipBox.FlatBoxOnAFrustumPlaneKeepsItsCorners and the property tests beside it.
constexpr double kRounding = 0x1p-48;

Plane plane_through(const glm::dvec3& normal, const glm::dvec3& point, double inset) {
    return {normal, -glm::dot(normal, point) - inset};
}

/// Bounds the terms of dot(normal, p) + offset over the box: the unit of their rounding error.
double magnitude(const Plane& plane, const glm::dvec3& farthest_abs) {
    return glm::dot(glm::abs(plane.normal), farthest_abs) + std::abs(plane.offset);
}

struct Segment {
    glm::dvec3 a;
    glm::dvec3 b;
};

/// Planes that cut the box, relative to its centre, each with the distance outside that still counts as on it.
struct Clipper {
    struct Slab {
        Plane plane;
        double tolerance = 0.0;
    };
    Slab slabs[kMaxClipPlanes];
    std::uint32_t count = 0;
    glm::dvec3 centre{0.0};
    glm::dvec3 half{0.0};
    glm::dvec3 half_tolerance{0.0};

    bool contains(const glm::dvec3& p) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            if (!(glm::dot(slabs[i].plane.normal, p) + slabs[i].plane.offset >= -slabs[i].tolerance)) return false;
        }
        return true;
    }

    /// Returns the part of the segment inside all planes. An end within tolerance stays unchanged, bit for bit.
    std::optional<Segment> clipped(Segment s) const {
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto& [plane, tolerance] = slabs[i];
            const double at_a = glm::dot(plane.normal, s.a) + plane.offset;
            const double at_b = glm::dot(plane.normal, s.b) + plane.offset;
            const bool a_in = at_a >= -tolerance;
            const bool b_in = at_b >= -tolerance;
            if (a_in && b_in) continue;
            if (!a_in && !b_in) return std::nullopt;
            const double t = std::clamp(at_a / (at_a - at_b), 0.0, 1.0);
            const glm::dvec3 hit = s.a * (1.0 - t) + s.b * t;
            (a_in ? s.b : s.a) = hit;
        }
        return s;
    }

    /// Returns the part inside the box of the line where planes i and j meet.
    std::optional<Segment> edge_in_box(std::uint32_t i, std::uint32_t j) const {
        const Plane& p = slabs[i].plane;
        const Plane& q = slabs[j].plane;
        const glm::dvec3 direction = glm::cross(p.normal, q.normal);
        const double square = glm::dot(direction, direction);
        const double parallel = kRounding * kRounding * glm::dot(p.normal, p.normal) * glm::dot(q.normal, q.normal);
        if (!(square > parallel)) return std::nullopt;
        const glm::dvec3 nearest =
            (glm::cross(direction, q.normal) * p.offset + glm::cross(p.normal, direction) * q.offset) / square;
        const double longest = std::sqrt(square);
        double from = -std::numeric_limits<double>::infinity();
        double to = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(direction[axis]) <= kRounding * longest) {
                if (!(std::abs(nearest[axis]) <= half[axis] + half_tolerance[axis])) return std::nullopt;
                continue;
            }
            const double t0 = (-half[axis] - nearest[axis]) / direction[axis];
            const double t1 = (half[axis] - nearest[axis]) / direction[axis];
            from = std::max(from, std::min(t0, t1));
            to = std::min(to, std::max(t0, t1));
        }
        if (!(from <= to)) return std::nullopt;
        return Segment{nearest + from * direction, nearest + to * direction};
    }
};

/// Returns nothing if the whole box is outside a plane, or a number is not finite.
std::optional<Clipper> make_clipper(std::span<const Plane> planes, const Aabb& box) {
    Clipper c;
    c.centre = math::centre(box);
    c.half = half_extent(box);
    if (!is_finite(c.centre) || !is_finite(c.half) || planes.size() > kMaxClipPlanes) return std::nullopt;
    const glm::dvec3 farthest_abs = glm::max(glm::abs(box.min), glm::abs(box.max));
    double largest = std::max({farthest_abs.x, farthest_abs.y, farthest_abs.z});
    for (const Plane& plane : planes) {
        const double tolerance = kRounding * magnitude(plane, farthest_abs);
        if (!std::isfinite(tolerance)) return std::nullopt;
        const double at_centre = glm::dot(plane.normal, c.centre) + plane.offset;
        const double reach = glm::dot(glm::abs(plane.normal), c.half);
        if (at_centre + reach < -tolerance) return std::nullopt;
        if (at_centre - reach < 0.0) c.slabs[c.count++] = {{plane.normal, at_centre}, tolerance};
    }
    c.half_tolerance = glm::dvec3(kRounding * largest);
    return c;
}

}  // namespace

glm::dmat3 basis_from_back(const glm::dvec3& back) {
    // Scaled first, because squares of very small or very large numbers leave the range of double.
    const glm::dvec3 scaled = back / std::max({std::abs(back.x), std::abs(back.y), std::abs(back.z)});
    const glm::dvec3 n = scaled / std::sqrt(glm::dot(scaled, scaled));
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {glm::dvec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), glm::dvec3(b, sign + n.y * n.y * a, -n.y),
            n};
}

Frustum perspective_frustum(const glm::dvec3& position, const glm::dmat3& rotation, double tan_half_x,
                            double tan_half_y, double near_m, double far_m) {
    const glm::dvec3 right = rotation[0];
    const glm::dvec3 up = rotation[1];
    const glm::dvec3 back = rotation[2];
    Frustum f;
    f.planes[0] = plane_through(right - tan_half_x * back, position, 0.0);
    f.planes[1] = plane_through(-right - tan_half_x * back, position, 0.0);
    f.planes[2] = plane_through(up - tan_half_y * back, position, 0.0);
    f.planes[3] = plane_through(-up - tan_half_y * back, position, 0.0);
    f.planes[4] = plane_through(-back, position, near_m);
    f.planes[5] = plane_through(back, position, -far_m);
    f.plane_count = far_m < std::numeric_limits<double>::infinity() ? 6 : 5;
    return f;
}

Frustum orthographic_frustum(const glm::dvec3& position, const glm::dmat3& rotation, double half_width,
                             double half_height, double near_m, double far_m) {
    const glm::dvec3 right = rotation[0];
    const glm::dvec3 up = rotation[1];
    const glm::dvec3 back = rotation[2];
    Frustum f;
    f.planes[0] = plane_through(right, position, -half_width);
    f.planes[1] = plane_through(-right, position, -half_width);
    f.planes[2] = plane_through(up, position, -half_height);
    f.planes[3] = plane_through(-up, position, -half_height);
    f.planes[4] = plane_through(-back, position, near_m);
    f.planes[5] = plane_through(back, position, -far_m);
    f.plane_count = far_m < std::numeric_limits<double>::infinity() ? 6 : 5;
    return f;
}

Overlap overlap(std::span<const Plane> planes, const Aabb& box) {
    if (is_empty(box)) return Overlap::outside;
    const glm::dvec3 farthest_abs = glm::max(glm::abs(box.min), glm::abs(box.max));
    Overlap result = Overlap::inside;
    for (const Plane& plane : planes) {
        const glm::dvec3 at_min = plane.normal * box.min, at_max = plane.normal * box.max;
        const glm::dvec3 highest = glm::max(at_min, at_max), lowest = glm::min(at_min, at_max);
        const double tolerance = kRounding * magnitude(plane, farthest_abs);
        // NaN (an infinite box, a broken plane) decides nothing: the box stays.
        if (highest.x + highest.y + highest.z + plane.offset < -tolerance) return Overlap::outside;
        if (!(lowest.x + lowest.y + lowest.z + plane.offset >= -tolerance)) result = Overlap::partial;
    }
    return result;
}

Overlap overlap(std::span<const Plane> planes, const Aabb& box, OpenTests& open) {
    if (is_empty(box)) return Overlap::outside;
    Overlap result = Overlap::inside;
    const OpenTests mine = open_tests(planes.size());
    for (OpenTests left = open & mine; left != 0; left &= left - 1) {
        const Plane& plane = planes[static_cast<std::size_t>(std::countr_zero(left))];
        const glm::dvec3 at_min = plane.normal * box.min, at_max = plane.normal * box.max;
        const glm::dvec3 lowest = glm::min(at_min, at_max);
        const double least = lowest.x + lowest.y + lowest.z + plane.offset;
        if (least >= 0.0) {
            open &= ~(left & -left);
            continue;
        }
        const glm::dvec3 highest = glm::max(at_min, at_max);
        const double most = highest.x + highest.y + highest.z + plane.offset;
        const double tolerance = kRounding * magnitude(plane, glm::max(glm::abs(box.min), glm::abs(box.max)));
        if (most < -tolerance) return Overlap::outside;
        if (!(least >= -tolerance)) result = Overlap::partial;
    }
    return result;
}

bool may_overlap(const Frustum& f, const Aabb& box) { return overlap(planes_of(f), box) != Overlap::outside; }

// A vertex of box ∩ frustum is where three planes meet. Three planes of the box: a corner. Two of one and one of the
// other: an edge crosses a face. Three planes of the frustum: its corner, an end of its edges. Hence the corners and
// clipped edges of both are complete.
std::size_t clip_box(std::span<const Plane> planes, const Aabb& box, std::vector<glm::dvec3>& out) {
    if (is_empty(box) || !math::is_finite(box)) return 0;
    const std::optional<Clipper> clipper = make_clipper(planes, box);
    if (!clipper) return 0;
    const std::size_t before = out.size();
    const auto push = [&](const glm::dvec3& p) { out.push_back(glm::clamp(clipper->centre + p, box.min, box.max)); };

    const std::array<glm::dvec3, 8> local = corners({-clipper->half, clipper->half});
    const std::array<glm::dvec3, 8> exact = corners(box);
    if (clipper->count == 0) {
        out.insert(out.end(), exact.begin(), exact.end());
        return exact.size();
    }
    for (unsigned i = 0; i < local.size(); ++i) {
        if (clipper->contains(local[i])) out.push_back(exact[i]);
        for (unsigned bit = 1; bit < local.size(); bit <<= 1) {
            if (i & bit) continue;
            const auto part = clipper->clipped({local[i], local[i | bit]});
            if (!part) continue;
            if (part->a != local[i]) push(part->a);
            if (part->b != local[i | bit]) push(part->b);
        }
    }
    for (std::uint32_t i = 0; i < clipper->count; ++i) {
        for (std::uint32_t j = i + 1; j < clipper->count; ++j) {
            auto part = clipper->edge_in_box(i, j);
            if (part) part = clipper->clipped(*part);
            if (!part) continue;
            push(part->a);
            push(part->b);
        }
    }
    return out.size() - before;
}

Aabb clipped_bounds(std::span<const Plane> planes, const Aabb& box) {
    constexpr int kRounds = 3;  // a cut along one axis can allow a cut along the next
    Aabb left = box;
    for (int round = 0; round < kRounds; ++round) {
        for (const Plane& plane : planes) {
            if (is_empty(left)) return left;
            const double tolerance = kRounding * magnitude(plane, glm::max(glm::abs(left.min), glm::abs(left.max)));
            for (int axis = 0; axis < 3; ++axis) {
                const glm::dvec3 highest = glm::max(plane.normal * left.min, plane.normal * left.max);
                const double others = plane.offset + tolerance + highest[(axis + 1) % 3] + highest[(axis + 2) % 3];
                const double n = plane.normal[axis], end = -others / n;
                if (n > 0.0 && end > left.min[axis]) left.min[axis] = end;
                if (n < 0.0 && end < left.max[axis]) left.max[axis] = end;
            }
        }
    }
    return left;
}

}  // namespace gnomon::math
