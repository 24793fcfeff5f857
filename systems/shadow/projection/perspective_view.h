#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/projection/perspective_range.h"

namespace gnomon::shadow {

/// Rectangle on the plane at distance 1 from an apex: tangents x/z and y/z, z along the view. low < high.
struct TangentRectangle {
    glm::dvec2 low{-1.0}, high{1.0};
    bool operator==(const TangentRectangle&) const = default;
};

/// Returns the texels left free at each border of a map, at most a quarter of its edge: 2 * reach_texel + 1. A filter
/// of half-width reach_texel reads that far beyond its point, and the bias may move the point as far. One is for
/// snapping.
double border_px(double size_px, double reach_texel);

/// Widens the rectangle by border_px to each side, for a map of size_px.
TangentRectangle with_border(const TangentRectangle& rectangle, double size_px, double reach_texel);

/// Returns a perspective view from apex_ws_m along -rotation_ws[2], off-centre where the rectangle is. The anchor lies
/// `anchored_m` metres before the apex along the view. 0 < near < far, all finite.
ShadowView perspective_view(const glm::dvec3& apex_ws_m, const glm::dmat3& rotation_ws,
                            const TangentRectangle& rectangle, const PerspectiveRange& range, double size_px,
                            double anchored_m = 0.0);

}  // namespace gnomon::shadow
