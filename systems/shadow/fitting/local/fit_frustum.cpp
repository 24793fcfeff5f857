#include "systems/shadow/fitting/local/fit_frustum.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "systems/shadow/fitting/directional/caster_depth_range.h"
#include "systems/shadow/fitting/local/fit_hysteresis.h"
#include "systems/shadow/fitting/local/frustum_content.h"
#include "systems/shadow/projection/depth_range_override.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {
namespace {

/// Returns the filter radius that the view's border is made for, texels.
float reach_texel(const FitInput& input, const TangentRectangle& crop, const PerspectiveRange& range) {
    const FilterSettings& filter = input.request.map.filtering;
    if (!needs_distances(filter)) return input.reach_texel;
    const glm::dvec2 sides = crop.high - crop.low;
    // The source stands across the ray. Away from the axis its image is longer, as 1 / cos (light_size.glsl).
    const glm::dvec2 corner = glm::max(glm::abs(crop.low), glm::abs(crop.high));
    const double longer = std::sqrt(1.0 + glm::dot(corner, corner));
    const double widest =
        longer * static_cast<double>(filter.source_radius_m) * (1.0 / range.near_m - 1.0 / range.far_m);
    return penumbra_border_texel(input, std::min(sides.x, sides.y), widest);
}

/// Returns the distance from the light to its view's anchor, metres. 0: the light itself. Around an aimed far lamp,
/// floats do not resolve small things where its light falls. Conservative maps are anchored at the light: rays decide
/// what they leave undecided.
double anchored_m(const FitInput& input) {
    if (!input.request.projection.aim.used || input.request.rays.used) return 0.0;
    return glm::distance(input.light.position_ws_m, input.request.projection.aim.middle_ws_m);
}

/// Returns the depth range of the view. In an aimed view it is as short as the lit sphere, so that depths resolve a
/// share of the range instead of the distance.
PerspectiveRange depth_range(const FitInput& input, const FrustumContent& content, const ViewFitHistory& previous,
                             ViewFitHistory& next) {
    const double anchor_m = anchored_m(input), nearest_m = content.nearest_m, farthest_m = content.farthest_m;
    const bool near_is_free = is_near_free(input.request);
    if (!(anchor_m > 0.0)) return held_range(nearest_m, farthest_m, near_is_free, previous, next);
    return held_range_around({anchor_m, input.request.projection.aim.radius_m}, nearest_m, farthest_m, near_is_free,
                             previous, next);
}

}  // namespace

bool fit_frustum(const FitInput& input, const LightFrustum& frustum, const ReceiverHull& receiver_hull,
                 std::vector<ShadowView>& views) {
    const TangentRectangle whole{frustum.low, frustum.high};
    FrustumContent content = visible_content(input, receiver_hull, whole);
    if (!content.receivers) return true;
    const ViewFitHistory& previous = input.previous.views[frustum.held_as];
    ViewFitHistory next = previous;
    const TangentRectangle crop = held_rectangle(content.footprint, whole, previous, next);
    const bool has_size = needs_distances(input.request.map.filtering);
    const auto reach = static_cast<double>(input.reach_texel);
    include_casters(input, receiver_hull, has_size ? with_border(crop, input.request.map.resolution_px, reach) : crop,
                    content);
    if (!content.casters) return true;
    const PerspectiveRange range = overridden(input.request.projection, depth_range(input, content, previous, next));
    if (!(range.near_m < range.far_m) || !std::isfinite(range.far_m)) return false;
    next.used = true;
    input.next.views[frustum.held_as] = next;
    const double size_px = input.request.map.resolution_px;
    const auto border_texel = static_cast<double>(reach_texel(input, crop, range));
    ShadowView view = perspective_view(receiver_hull.origin_ws_m, frustum.axes,
                                       with_border(crop, size_px, border_texel), range, size_px, anchored_m(input));
    view.layer = frustum.layer;
    view.stays = true;
    views.push_back(view);
    return true;
}

}  // namespace gnomon::shadow
