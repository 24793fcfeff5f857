#pragma once
#include <cmath>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_frame.h"

/// What sets and fits must be true of, decided in long double and in another way than they decide it: point by point.
/// Points are world space. Bounds stand for meshes, as they do for sets and fits.
namespace gnomon::oracle {

using Real = long double;
struct Vector {
    Real x = 0, y = 0, z = 0;
    Real operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};
inline Vector exact(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(Real s, const Vector& v) { return {s * v.x, s * v.y, s * v.z}; }
inline Real dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Real length(const Vector& v) { return std::sqrt(dot(v, v)); }

/// Returns whether the consumer sees the point, by a clear share `inset` of its field and range.
bool sees(const ConsumerItem& consumer, const Vector& p, Real inset);

/// Returns whether the light's rays reach the point, if nothing is in the way, by a clear share `inset` of its range
/// and cone.
bool reaches(const LightItem& light, const Vector& p, Real inset);

/// Returns whether the light's ray to `p` passes through the box before the point. More than the share `least` of the
/// box's size must lie between.
bool darkens(const LightItem& light, const math::Aabb& box, const Vector& p, Real least);

/// Map coordinates and depth (0 to 1 each) of a point, by the view's float matrix, and the greatest rounding of each.
/// That is 2^-22 of its terms, for the matrix and for the shader's own sums, not for this oracle's.
struct InMap {
    Vector at, rounding;
    Real w = 0;  // > 0: before the view
};
InMap in_map(const shadow::ShadowView& view, const Vector& p);

/// Views of a light that decide about a point, as the shaders choose them.
/// - A sun: the first cascade with the point in its map, at least `reach_texel` from the border. Where cascades have
///   ends, the search begins at the cascade of the point's distance.
/// - A point light or a wide spot: the face of its cube that the point lies in, if that is a view.
/// - A spot: its single view.
struct Deciding {
    const shadow::ShadowView* view = nullptr;  // cascade or face
    const shadow::ShadowView* single = nullptr;
    bool wants_view = false, wants_single = false;  // the light has such views
};
Deciding deciding_views(std::span<const shadow::ShadowView> views, const shadow::ShadowRequest& demand,
                        const ConsumerItem& consumer, const Vector& p, Real reach_texel);

/// Returns whether the point lies in the view's map and depth range, `reach_texel` from its border, rounding in its
/// favour. Points nearer than a perspective view's near plane count: they are compared as if they lay on that plane.
bool holds(const shadow::ShadowView& view, const Vector& p, Real size_px, Real reach_texel);

}  // namespace gnomon::oracle
