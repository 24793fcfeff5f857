#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "systems/shadow/fitting/local/fit_frustum.h"
#include "systems/shadow/fitting/local/fit_hysteresis.h"
#include "systems/shadow/fitting/local/frustum_content.h"
#include "systems/shadow/projection/depth_range_override.h"
#include "systems/shadow/projection/light_frusta.h"
#include "systems/shadow/request/light_kinds.h"

/// Point light: views of the faces of a cube map in which a receiver is seen and a caster stands. All faces share near
/// and far, since a filter's tap may cross a seam. Both are kept by hysteresis (fit_hysteresis.h). A far point light
/// has one view of what is seen instead (far_lamp_aim.h), and is looked up as a spot is.
namespace gnomon::shadow {

namespace {

constexpr double kOneTap_texel = 0.5;  // radius of a filter that reads the nearest texel only

ShadowView face_view(const FitInput& input, const ReceiverHull& receiver_hull, const LightFrustum& frustum,
                     const PerspectiveRange& range) {
    const std::uint32_t face = frustum.layer;
    ShadowView view = perspective_view(receiver_hull.origin_ws_m, frustum.axes, TangentRectangle{}, range,
                                       input.request.map.resolution_px);
    view.projection = ViewProjection::cube_face;
    view.layer = face;
    view.stays = true;
    return view;
}

}  // namespace

bool fit_point(const FitInput& input, std::vector<ShadowView>& views) {
    const LightFrusta frusta = light_frusta(input.light, input.request);
    input.next.aim = input.request.projection.aim;
    if (input.request.projection.aim.used) return fit_frustum(input, frusta.items[0], input.hulls[0], views);
    std::array<FrustumContent, 6> faces;
    double nearest_m = HUGE_VAL, farthest_m = 0.0;
    bool any = false;
    for (std::uint32_t i = 0; i < frusta.count; ++i) {
        const TangentRectangle whole{frusta.items[i].low, frusta.items[i].high};
        faces[i] = visible_content(input, input.hulls[i], whole);
        if (!faces[i].receivers) continue;
        include_casters(input, input.hulls[i], whole, faces[i]);
        any = any || faces[i].casters;
        nearest_m = std::min(nearest_m, faces[i].nearest_m);
        farthest_m = std::max(farthest_m, faces[i].farthest_m);
    }
    if (!any) return true;
    ViewFitHistory next = input.previous.views[0];
    const PerspectiveRange range =
        overridden(input.request.projection,
                   held_range(nearest_m, farthest_m, is_near_free(input.request), input.previous.views[0], next));
    if (!(range.near_m < range.far_m) || !std::isfinite(range.far_m)) return false;
    next.used = true;
    input.next.views[0] = next;
    // A filter that blends texels reads across seams. A face that is seen but has no caster must then be empty.
    const bool blends = static_cast<double>(input.reach_texel) > kOneTap_texel;
    for (std::uint32_t face = 0; face < frusta.count; ++face)
        if (faces[face].receivers && (faces[face].casters || blends))
            views.push_back(face_view(input, input.hulls[face], frusta.items[face], range));
    return true;
}

}  // namespace gnomon::shadow
