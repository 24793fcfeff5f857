#include "systems/shadow/projection/perspective_view.h"

#include <algorithm>
#include <cmath>

#include "engine/math/projection.h"

namespace gnomon::shadow {

double border_px(double size_px, double reach_texel) {
    return std::min(std::ceil(2.0 * reach_texel) + 1.0, 0.25 * size_px);
}

TangentRectangle with_border(const TangentRectangle& rectangle, double size_px, double reach_texel) {
    const glm::dvec2 border =
        (rectangle.high - rectangle.low) * (1.0 / (size_px / border_px(size_px, reach_texel) - 2.0));
    return {rectangle.low - border, rectangle.high + border};
}

ShadowView perspective_view(const glm::dvec3& apex_ws_m, const glm::dmat3& rotation_ws,
                            const TangentRectangle& rectangle, const PerspectiveRange& range, double size_px,
                            double anchored_m) {
    ShadowView view;
    view.projection = ViewProjection::perspective;
    view.pose.anchor_ws_m = apex_ws_m - rotation_ws[2] * anchored_m;
    view.pose.apex_m = anchored_m;
    view.pose.axis_u = rotation_ws[0];
    view.pose.axis_v = rotation_ws[1];
    view.pose.axis_back = rotation_ws[2];
    view.depth.near_m = range.near_m;
    view.depth.far_m = range.far_m;
    view.plane.tan_low = rectangle.low;
    view.plane.tan_high = rectangle.high;
    const glm::dvec2 texel = (rectangle.high - rectangle.low) / size_px;
    view.plane.texel_u = texel.x;
    view.plane.texel_v = texel.y;
    view.depth.alpha = -range.near_m / (range.far_m - range.near_m);
    view.depth.beta = range.near_m * range.far_m / (range.far_m - range.near_m);

    glm::dmat4 view_from_anchor(glm::transpose(rotation_ws));
    view_from_anchor[3].z = -anchored_m;
    const glm::dmat4 clip_from_anchor = math::reversed_perspective(rectangle.low.x, rectangle.high.x, rectangle.low.y,
                                                                   rectangle.high.y, range.near_m, range.far_m) *
                                        view_from_anchor;
    view.clip_from_anchor = glm::mat4(clip_from_anchor);
    view.map_from_anchor = glm::mat4(math::texture_from_clip() * clip_from_anchor);
    return view;
}

}  // namespace gnomon::shadow
