#pragma once
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

/// A camera or light volume as planes, convex.
/// At most 6: left, right, bottom, top, near, far (far is absent when infinite).
struct Frustum {
    Plane planes[6];
    std::uint32_t plane_count = 0;
};

/// Orientation whose columns are right, up, back: looking along -Z of the result.
/// `back` must be non-zero and finite; it is normalised. Branchless for every direction
/// (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017): continuous except at back.z = 0-.
glm::dmat3 basis_from_back(const glm::dvec3& back);

/// Volume of a perspective view at `position` whose columns of `rotation` are right, up, back.
/// tan_half: tangents of the half angles (x, y), > 0. An infinite far_m leaves 5 planes.
Frustum perspective_frustum(const glm::dvec3& position, const glm::dmat3& rotation, double tan_half_x,
                            double tan_half_y, double near_m, double far_m);
Frustum orthographic_frustum(const glm::dvec3& position, const glm::dmat3& rotation, double half_width,
                             double half_height, double near_m, double far_m);

inline std::span<const Plane> planes_of(const Frustum& f) { return {f.planes, f.plane_count}; }

/// `outside` only if the box lies wholly outside one plane, `inside` only if wholly inside all, both up to 2^-48 of the
/// size of the plane equation's terms; NaN planes decide nothing. Empty boxes: outside.
enum class Overlap : std::uint8_t { outside, partial, inside };
Overlap overlap(std::span<const Plane> planes, const Aabb& box);

/// False only if the box lies wholly outside one plane (conservative, also against rounding and NaN planes).
/// Empty boxes: false.
bool may_overlap(const Frustum& f, const Aabb& box);

/// What clip_box can take at once: a camera's 6 planes, the 4 of a light's view, and 6 more.
inline constexpr std::size_t kMaxClipPlanes = 16;

/// Vertices of the convex polytope box ∩ planes, some of them possibly more than once, in no particular order.
/// Appends to `out` and returns the number added; 0 if the intersection is empty, or the box or a plane is not finite,
/// or there are more than kMaxClipPlanes. Planes that do not cut the box cost next to nothing.
/// Holds for flat boxes, boxes around the whole frustum, and frusta without a far plane. Scale-free: scaling box and
/// offsets by a power of two scales the result exactly. Points lie in the box, and inside each plane up to 2^-48 of
/// the size of the plane equation's terms.
std::size_t clip_box(std::span<const Plane> planes, const Aabb& box, std::vector<glm::dvec3>& out);
/// By how much rounding may have moved a clipped point that is then expressed in other axes, of the size of its
/// coordinates: 16 units (2^-52) of the clip and as many of the subtraction and the products.
inline constexpr double kClippedRounding = 0x1p-47;
/// A box around box ∩ planes: often the smallest, never less, no points kept. Empty only if that is; a plane
/// or a side that is not finite takes nothing away.
Aabb clipped_bounds(std::span<const Plane> planes, const Aabb& box);
inline std::size_t clip_box(const Frustum& f, const Aabb& box, std::vector<glm::dvec3>& out) {
    return clip_box(planes_of(f), box, out);
}

}  // namespace gnomon::math
