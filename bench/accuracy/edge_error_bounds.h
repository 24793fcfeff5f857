#pragma once
#include <vector>

#include "engine/gl/device.h"
#include "systems/shadow/frame/shadow_view.h"
#include "tests/oracle/edge_exceptions.h"

namespace gnomon::bench {

/// Predicted errors of shadow edges, surface point by surface point: systems/shadow/fitting/error_bound.h for the view
/// that serves the point. Repeats the frame's own fits, which are pure functions.
class EdgeBounds {
public:
    /// Repeats the fits of a frame from the history that they left, with the budget's limits per light. The scene must
    /// outlive this. Positions below are relative to its first consumer.
    EdgeBounds(const SceneSnapshot& scene, const gl::DeviceInfo& device, const shadow::History& held);

    /// Returns the texel at a point and the predicted error of an edge there. Points in no view are lit: no texel, and
    /// only the picture's own pixels as error. `telling`: factor on the texel's size; other than 1 it shows how a wrong
    /// prediction looks.
    oracle::TexelThere at(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal,
                          double telling = 1.0) const;

    /// Returns the texel that may move an edge there, and the error that the light's target allows
    /// (systems/shadow/request/accuracy_target.h). `target_factor`: factor on both; other than 1 it shows how a missed
    /// target looks.
    oracle::TexelThere of_target(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal,
                                 double target_factor) const;

    /// Returns the same for an allowed error of `error_px` beside the picture's own pixel, whatever the light's target.
    oracle::TexelThere within(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal,
                              double error_px, double target_factor = 1.0) const;

    /// Returns the texel that may move an edge there; no error is allowed. `telling`: as at().
    oracle::TexelThere resolving(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal,
                                 double telling = 1.0) const {
        return within(light, point_rel_m, normal, 0.0, telling);
    }

    /// Returns the width of a caster, across the light at the point, that the texel there resolves, metres.
    double resolved_m(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal) const;

    /// Returns the edge of the light's maps that the bounds are for, texels; 0: it has none.
    std::uint32_t map_px(std::uint32_t light) const { return fitted_.lights[light].request.map.resolution_px; }

    /// Returns the error that the view serving the point states for receivers of its slope, pixels; 0: no view serves
    /// it.
    double stated_px(std::uint32_t light, const glm::dvec3& point_rel_m, const glm::dvec3& normal) const;

private:
    const shadow::ShadowView* view_of(std::uint32_t light, const glm::dvec3& point_ws_m) const;
    double reach_texel(const shadow::ShadowView& view) const;
    double edge_texel(const shadow::ShadowView& view) const;

    const SceneSnapshot& scene_;
    shadow::FittedViews fitted_;
};

}  // namespace gnomon::bench
