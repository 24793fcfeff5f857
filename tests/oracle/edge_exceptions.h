#pragma once
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "tests/oracle/metrics.h"
#include "tests/oracle/reference_tracer.h"

/// Why a shadow edge may be farther off than predicted: decided by the traced world alone, never by how far it is off.
namespace gnomon::oracle {

/// The texel that decides a surface point.
struct TexelThere {
    glm::dvec3 u_m{0.0}, v_m{0.0};  // its sides, across the light
    double filter_texel = 0.5;  // the filter's half-width E
    double reach_texel = 0.5;  // half-width of what decides a pixel: E, and the offset along the normal if there is one
    double error_px = 0.0;     // how far a shadow edge may be off there
    double depth_m = 0.0;      // along the ray: depths do not distinguish casters nearer to the surface from it
};
/// Texel that decides a point relative to the tracer's origin, on a surface with that unit normal.
using TexelAt = std::function<TexelThere(const glm::dvec3& point_rel_m, const glm::dvec3& normal)>;

struct EdgeExceptions {
    std::size_t truth_ambiguous = 0;   // the true edge runs between pixels, and at least one is ambiguous
    std::size_t sub_texel_caster = 0;  // the shadow, or the light beside it, contains no whole texel within the bound
    std::size_t unexplained = 0;       // neither: the bound is wrong there
    std::size_t excusable = 0, sampled = 0;  // every kSampleEvery-th place, however far off: in a named class; all
    std::vector<std::size_t> unexplained_places;  // indices into EdgeDisplacement::each
    std::size_t beyond() const { return truth_ambiguous + sub_texel_caster + unexplained; }
};
inline constexpr std::size_t kSampleEvery = 64;

/// Names each place of `edge` that is farther off than TexelThere::error_px of its surfaces.
///
/// A map knows the light at texel centres only. So it shows an edge for certain only between two footprints of texels,
/// one wholly in shadow and one wholly in light. Where rays do not find both, the place is a `sub_texel_caster`. They
/// look across the true edge, to the bound's distance, on the plane that is seen there and its continuation. They must
/// find a place with its whole footprint blocked on the dark side, and a place with none of it blocked on the other.
/// Casters count that stand off the plane by more than its own rise over the footprint and the steps of the map's depth
/// format. Depths do not distinguish nearer casters from the plane.
EdgeExceptions edge_exceptions(const ReferenceTracer& tracer, const PrimaryHits& hits, const ConsumerItem& consumer,
                               const LightItem& light, const LightTruth& truth, const EdgeDisplacement& edge,
                               const TexelAt& texel_at);

}  // namespace gnomon::oracle
