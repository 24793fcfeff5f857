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

/// Whether the consumer sees the point, by a clear share `inset` of its field and range.
bool sees(const ConsumerItem& consumer, const Vector& p, Real inset);

/// Whether the light's rays reach the point, were nothing in the way, by a clear share `inset` of its range and cone.
bool reaches(const LightItem& light, const Vector& p, Real inset);

/// Whether the light's ray to `p` passes the inside of the box on its way: more than `least` of the box's size lies
/// between, and not only at the point itself.
bool darkens(const LightItem& light, const math::Aabb& box, const Vector& p, Real least);

/// Map coordinates and depth (0 to 1 each) of a point, by the view's float matrix, and how much of each float may owe
/// to rounding (2^-22 of its terms: of the matrix and of the shader's own sums, not of this oracle's).
struct InMap {
    Vector at, rounding;
    Real w = 0;  // > 0: before the view
};
InMap in_map(const shadow::ShadowView& view, const Vector& p);

/// Which views of a light decide about a point, as the shaders choose: a sun's first cascade that holds it with
/// `reach_texel` to spare, from the one of its distance on where cascades have ends; the face it lies in of the cube
/// around a point light or a wide spot, if that is a view; a spot's single view.
struct Deciding {
    const shadow::ShadowView* view = nullptr;  // cascade or face
    const shadow::ShadowView* single = nullptr;
    bool wants_view = false, wants_single = false;  // the light has such views
};
Deciding deciding_views(std::span<const shadow::ShadowView> views, const shadow::ShadowRequest& demand,
                        const ConsumerItem& consumer, const Vector& p, Real reach_texel);

/// Whether the point lies in the view's map and depth range, `reach_texel` from its border, rounding in its favour.
/// What is nearer than a perspective view's near plane is held: it is compared as if it lay on that plane.
bool holds(const shadow::ShadowView& view, const Vector& p, Real size_px, Real reach_texel);

}  // namespace gnomon::oracle
