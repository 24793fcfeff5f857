#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/projection/perspective_range.h"

namespace gnomon::shadow {

/// Part of a plane at distance 1 from an apex: tangents x/z and y/z, z along the view. low < high.
struct TangentRectangle {
    glm::dvec2 low{-1.0}, high{1.0};
    bool operator==(const TangentRectangle&) const = default;
};

/// Texels left free at each border of a map: as many as a filter of half-width reach_texel reads beyond the point that
/// it is asked for, as many again by which the bias may have moved that point, and one for snapping. Never more than a
/// quarter of the map.
double border_px(double size_px, double reach_texel);

/// Widened by border_px to each side, for a map of size_px.
TangentRectangle with_border(const TangentRectangle& rectangle, double size_px, double reach_texel);

/// One perspective view from apex_ws_m along -rotation_ws[2], off its centre where the rectangle is.
/// The anchor is the apex. 0 < near < far, all finite.
ShadowView perspective_view(const glm::dvec3& apex_ws_m, const glm::dmat3& rotation_ws,
                            const TangentRectangle& rectangle, const PerspectiveRange& range, double size_px);

/// The same with a border, and the anchor so far before the apex.
ShadowView perspective_view(const glm::dvec3& apex_ws_m, const glm::dmat3& rotation_ws,
                            const TangentRectangle& rectangle, const PerspectiveRange& range, double size_px,
                            double reach_texel, double anchored_m = 0.0);

}  // namespace gnomon::shadow
