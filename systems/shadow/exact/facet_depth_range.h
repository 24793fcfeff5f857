#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "systems/extract/snapshot.h"
#include "systems/shadow/exact/caster_topology.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::shadow {

/// By how much a surface may depart from its depth at a texel's middle within that texel without being drawn, as depth:
/// of planes that the light meets at atan 4 from their normal; steeper ones are few.
struct SheetFloor {
    double departure = 0.0;  // orthographic: of such a plane, without margins
    float cleared = 0.0f;    // with them: what the map of departures is cleared to
    double share = 0.0;      // perspective: of depth less its constant part (ShadowView::depth_alpha), without margins;
                             // sheet_floor() in shaders/shadow/filters/exact/classify.glsl has it with them
};
SheetFloor sheet_floor(const ShadowView& view, std::uint32_t size_px);

/// Which facets of an instance depart by no more than that, whatever float does to their corners.
class FlatFacets {
public:
    FlatFacets(const CasterSurface& surface, const InstanceItem& item, const ShadowView& view, std::uint32_t size_px);

    /// `normal_vs`: along the view's axes, of any length. `height`: of the light above the facet's plane times that
    /// length (perspective), off by no more than `error`. `farthest_m`: of its corners, along the view (perspective).
    bool operator()(const CasterSurface::Facet& facet, const glm::dvec3& normal_vs, double height, double error,
                    double farthest_m) const;

private:
    bool orthographic(const CasterSurface::Facet& facet, const glm::dvec3& normal_vs) const;
    bool perspective(const CasterSurface::Facet& facet, const glm::dvec3& normal_vs, double height,
                     double farthest_m) const;

    SheetFloor floor_;
    bool parallel_ = false, possible_ = false;
    glm::dvec2 half_texel_{0.0};                // along u and v: metres, or tangents
    double depth_per_m_ = 0.0;                  // orthographic
    double off_m_ = 0.0;                        // perspective: how far float may take a corner
    double least_cosine_ = 0.0, widest_ = 1.0;  // of a flat facet's normal with (u, v, 1), and that squared
    double least_stretch_ = 0.0;                // of a length in the model at least so much is left in the world
};

}  // namespace gnomon::shadow
