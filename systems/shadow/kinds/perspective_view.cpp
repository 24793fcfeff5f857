#include "systems/shadow/kinds/perspective_view.h"

#include <cmath>

#include "engine/math/projection.h"

namespace gnomon::shadow {

ShadowView perspective_view(const glm::dvec3& apex_ws_m, const glm::dmat3& rotation_ws, double tan_half,
                            const PerspectiveRange& range, double size_px, double reach_texel) {
    ShadowView view;
    view.projection = ViewProjection::perspective;
    view.anchor_ws_m = apex_ws_m;
    view.axis_u = rotation_ws[0];
    view.axis_v = rotation_ws[1];
    view.axis_back = rotation_ws[2];
    view.near_m = range.near_m;
    view.far_m = range.far_m;
    const double margin_px = std::ceil(reach_texel) + 1.0;
    const double half = tan_half * size_px / (size_px - 2.0 * margin_px);
    view.texel_u = view.texel_v = 2.0 * half / size_px;
    view.depth_alpha = -range.near_m / (range.far_m - range.near_m);
    view.depth_beta = range.near_m * range.far_m / (range.far_m - range.near_m);

    const glm::dmat4 view_from_anchor(glm::transpose(rotation_ws));
    const glm::dmat4 clip_from_anchor =
        math::reversed_perspective(-half, half, -half, half, range.near_m, range.far_m) * view_from_anchor;
    view.clip_from_anchor = glm::mat4(clip_from_anchor);
    view.map_from_anchor = glm::mat4(math::texture_from_clip() * clip_from_anchor);
    return view;
}

}  // namespace gnomon::shadow
