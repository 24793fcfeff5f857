#include "systems/shadow/projection/orthographic_view.h"

#include "engine/math/projection.h"

namespace gnomon::shadow {

ShadowView orthographic_view(const OrthographicBox& box, double size_px) {
    ShadowView view;
    view.projection = ViewProjection::orthographic;
    view.pose.anchor_ws_m = box.anchor_ws_m;
    view.pose.axis_u = box.axes[0];
    view.pose.axis_v = box.axes[1];
    view.pose.axis_back = box.axes[2];
    view.depth.near_m = box.near_m;
    view.depth.far_m = box.far_m;
    view.plane.centre_ls_m = box.centre_m;
    view.plane.half_extent_m = box.half_extent_m;
    view.plane.texel_u = 2.0 * box.half_extent_m.x / size_px;
    view.plane.texel_v = 2.0 * box.half_extent_m.y / size_px;

    const glm::dvec2 low = box.centre_m - box.half_extent_m, high = box.centre_m + box.half_extent_m;
    const glm::dmat4 view_from_anchor(glm::transpose(box.axes));
    const glm::dmat4 clip_from_anchor =
        math::reversed_orthographic(low.x, high.x, low.y, high.y, box.near_m, box.far_m) * view_from_anchor;
    view.clip_from_anchor = glm::mat4(clip_from_anchor);
    view.map_from_anchor = glm::mat4(math::texture_from_clip() * clip_from_anchor);
    return view;
}

}  // namespace gnomon::shadow
