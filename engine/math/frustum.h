#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/math/aabb.h"

namespace gnomon::math {

/// Half-space dot(normal, p) + offset >= 0. The normal points inside; it need not be unit length.
struct Plane {
    glm::dvec3 normal{0.0, 1.0, 0.0};
    double offset = 0.0;
};

/// Camera or light volume as planes, convex. At most 6: left, right, bottom, top, near, far (far is absent when
/// infinite).
struct Frustum {
    Plane planes[6];
    std::uint32_t plane_count = 0;
};

/// Builds an orientation with the columns right, up, back: it looks along its own -Z. `back` must be non-zero and
/// finite; it is normalised. Branchless for every direction (Duff et al., "Building an Orthonormal Basis, Revisited",
/// JCGT 2017). Continuous except at back.z = 0-.
glm::dmat3 basis_from_back(const glm::dvec3& back);

/// Builds the volume of a perspective view at `position`. Columns of `rotation` are right, up, back. `tan_half_x`,
/// `tan_half_y`: tangents of the half angles, > 0. An infinite far_m leaves 5 planes.
Frustum perspective_frustum(const glm::dvec3& position, const glm::dmat3& rotation, double tan_half_x,
                            double tan_half_y, double near_m, double far_m);
Frustum orthographic_frustum(const glm::dvec3& position, const glm::dmat3& rotation, double half_width,
                             double half_height, double near_m, double far_m);

inline std::span<const Plane> planes_of(const Frustum& f) { return {f.planes, f.plane_count}; }

/// Result of a box against planes, up to 2^-48 of the size of the plane equation's terms. `outside`: wholly outside one
/// plane, or empty. `inside`: wholly inside all planes. NaN planes decide nothing.
enum class Overlap : std::uint8_t { outside, partial, inside };
Overlap overlap(std::span<const Plane> planes, const Aabb& box);

/// Bits of the tests that may still cut a box on the way down a tree; 0: all of the box is inside.
using OpenTests = std::uint64_t;
/// Returns the bits of all `count` tests, at most 64.
constexpr OpenTests open_tests(std::size_t count) { return count < 64 ? (OpenTests{1} << count) - 1 : ~OpenTests{0}; }

/// Does the same with the planes in `open` alone, at most 64: bit i is plane i. Clears the bits of planes that all
/// boxes within this one lie inside: sums of rounded products grow with the box's corners.
Overlap overlap(std::span<const Plane> planes, const Aabb& box, OpenTests& open);

/// Returns false only if the box is empty or lies wholly outside one plane. Conservative, also against rounding and NaN
/// planes.
bool may_overlap(const Frustum& f, const Aabb& box);

/// Maximum number of planes of clip_box: a camera's 6, a light view's 4, and 6 more.
inline constexpr std::size_t kMaxClipPlanes = 16;

/// Appends the vertices of the convex polytope box ∩ planes to `out`, in no particular order, possibly with
/// repetitions. Returns the number added. 0 if the intersection is empty, the box or a plane is not finite, or there
/// are more than kMaxClipPlanes. Planes that do not cut the box cost almost nothing. Handles flat boxes, boxes around
/// the whole frustum, and frusta without a far plane. Scale-free: scaling box and offsets by a power of two scales the
/// result exactly. Points lie in the box, and inside each plane up to 2^-48 of the size of the plane equation's terms.
std::size_t clip_box(std::span<const Plane> planes, const Aabb& box, std::vector<glm::dvec3>& out);
/// Rounding of a clipped point expressed in other axes, relative to its coordinates. Clipping takes 16 units (2^-52),
/// subtraction and products another 16.
inline constexpr double kClippedRounding = 0x1p-47;
/// Computes a box around box ∩ planes without keeping points: often the smallest, never too small. Empty only if the
/// intersection is. A plane or side that is not finite cuts nothing.
Aabb clipped_bounds(std::span<const Plane> planes, const Aabb& box);
inline std::size_t clip_box(const Frustum& f, const Aabb& box, std::vector<glm::dvec3>& out) {
    return clip_box(planes_of(f), box, out);
}

}  // namespace gnomon::math
