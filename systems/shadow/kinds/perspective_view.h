#pragma once
#include "systems/shadow/kinds/perspective_range.h"
#include "systems/shadow/types.h"

namespace gnomon::shadow {

/// One perspective view from apex_ws_m along -rotation_ws[2], square, tan_half to each side, widened by the room that a
/// filter of half-width reach_texel needs at the border of a map of size_px. The anchor is the apex.
/// tan_half > 0, 0 < near < far, both finite.
ShadowView perspective_view(const glm::dvec3& apex_ws_m, const glm::dmat3& rotation_ws, double tan_half,
                            const PerspectiveRange& range, double size_px, double reach_texel);

}  // namespace gnomon::shadow
