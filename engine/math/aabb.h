#pragma once
#include <array>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "gnomon/box.h"

/// Functions of boxes. A default box is the neutral element of merged().
namespace gnomon::math {

/// Box around everything.
inline constexpr Aabb kEverywhere{glm::dvec3(-std::numeric_limits<double>::infinity()),
                                  glm::dvec3(std::numeric_limits<double>::infinity())};

/// Returns true if all six numbers are finite.
bool is_finite(const Aabb& b);

inline glm::dvec3 centre(const Aabb& b) { return 0.5 * (b.min + b.max); }
inline glm::dvec3 half_extent(const Aabb& b) { return 0.5 * (b.max - b.min); }
/// Returns the axis of the largest number; the first of equal ones.
inline int longest_side(const glm::dvec3& size) {
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

/// Returns the smallest box around both. An empty or NaN box adds nothing, nor does a point with a NaN.
Aabb merged(const Aabb& a, const Aabb& b);
Aabb extended(const Aabb& a, const glm::dvec3& point);

/// Returns the common part; empty if they do not meet.
inline Aabb intersection(const Aabb& a, const Aabb& b) { return {glm::max(a.min, b.min), glm::min(a.max, b.max)}; }

/// Tests two closed boxes: touching counts as overlap. An empty box overlaps nothing.
bool overlaps(const Aabb& a, const Aabb& b);

/// Computes the box of the image of `b` under p -> basis * p + translation (Arvo 1990), exact up to rounding. Empty
/// stays empty; NaN in the basis or translation gives an empty box.
Aabb transformed(const Aabb& b, const glm::dmat3& basis, const glm::dvec3& translation);

/// Returns corner i at index i: bit 0 selects max x, bit 1 max y, bit 2 max z.
std::array<glm::dvec3, 8> corners(const Aabb& b);

/// Computes the distance from a point to the box (0 inside), or to its farthest corner. An empty box gives infinity and
/// 0; a point with a NaN gives NaN.
double distance(const Aabb& b, const glm::dvec3& point);
double farthest_distance(const Aabb& b, const glm::dvec3& point);

}  // namespace gnomon::math
