#pragma once
#include <vector>

#include "engine/gl/device.h"
#include "systems/shadow/frame/shadow_view.h"
#include "tests/oracle/edge_exceptions.h"

namespace gnomon::bench {

/// What the fits predict of shadow edges, surface point by surface point: systems/shadow/fitting/error_bound.h for the
/// view that serves the point. Works from a copy of the frame's own fits, which are pure.
class EdgeBounds {
public:
    /// `held`: what the fits of that frame left, and what a budget left each light. The scene must outlive this.
    /// Positions below are relative to its first consumer.
    EdgeBounds(const SceneSnapshot& scene, const gl::DeviceInfo& device, const shadow::History& held);

    /// `telling`: 1; else every texel is taken to be that many times as large as it is, to see what a wrong prediction
    /// looks like. Points that no view holds are lit: no texel, and an edge is off by the picture's own pixels alone.
    oracle::TexelThere at(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal,
                          double telling = 1.0) const;

    /// The texel that may move an edge there, and how far off the light's contract lets it be (shadow/contract.h).
    /// `wished`: 1; else both are taken to be that many times as large, to see what a broken contract looks like.
    oracle::TexelThere promised(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal,
                                double wished) const;

    /// The same where an edge may be off by `error_px` beside the picture's own pixel, whatever the contract.
    oracle::TexelThere within(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal,
                              double error_px, double wished = 1.0) const;

    /// Edge of the light's maps, for which all of this is said; 0: it has none.
    std::uint32_t map_px(std::uint32_t light) const { return fitted_.lights[light].request.map.resolution_px; }

    /// What the view that serves the point states for receivers of its slope; 0 where none does.
    double stated_px(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal) const;

private:
    const shadow::ShadowView* view_of(std::uint32_t light, const glm::dvec3& point_ws_m) const;
    double reach_texel(const shadow::ShadowView& view) const;
    double edge_texel(const shadow::ShadowView& view) const;

    const SceneSnapshot& scene_;
    shadow::FittedViews fitted_;
};

}  // namespace gnomon::bench
