#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "systems/extract/snapshot.h"
#include "systems/shadow/exact/caster_topology.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// Depth slope bound of surfaces that are not drawn: greatest change of depth between a texel's middle and its border.
/// It applies to planes with an angle of at most atan 4 between normal and light. Steeper ones are few, and are drawn.
struct BoundsFloor {
    double departure = 0.0;  // orthographic: bound for such a plane, without margins
    float cleared = 0.0f;    // with margins: what the map of slope bounds is cleared to
    double share = 0.0;      // perspective: the bound as a share of depth minus alpha (ViewDepths), without margins;
                             // sheet_floor_share() in shaders/shadow/filters/exact/classify.glsl has it with them
};
BoundsFloor bounds_floor(const ShadowView& view, std::uint32_t size_px);

/// Test for facets with a depth slope below that bound, whatever float's rounding does to their corners.
class FlatFacetTest {
public:
    FlatFacetTest(const CasterTopology& surface, const InstanceItem& item, const ShadowView& view,
                  std::uint32_t size_px);

    /// Returns whether the facet need not be drawn. `normal_vs`: along the view's axes, of any length. `height`: height
    /// of the light above the facet's plane times that length (perspective), off by at most `error`. `farthest_m`:
    /// greatest distance of its corners along the view (perspective).
    bool operator()(const CasterTopology::Facet& facet, const glm::dvec3& normal_vs, double height, double error,
                    double farthest_m) const;

private:
    bool orthographic(const CasterTopology::Facet& facet, const glm::dvec3& normal_vs) const;
    bool perspective(const CasterTopology::Facet& facet, const glm::dvec3& normal_vs, double height,
                     double farthest_m) const;

    BoundsFloor floor_;
    bool parallel_ = false, possible_ = false;
    glm::dvec2 half_texel_{0.0};                // along u and v: metres, or tangents
    double depth_per_m_ = 0.0;                  // orthographic
    double off_m_ = 0.0;                        // perspective: float's greatest error of a corner
    double least_cosine_ = 0.0, widest_ = 1.0;  // bounds on a flat facet: n · (u, v, 1), and |(u, v, 1)|²
    double least_stretch_ = 0.0;                // least factor from a length in the model to one in the world
};

}  // namespace gnomon::shadow
