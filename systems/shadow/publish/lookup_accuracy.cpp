#include "systems/shadow/publish/lookup_accuracy.h"

#include <algorithm>

#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/request/accuracy_target.h"

namespace gnomon::shadow {
namespace {

/// Returns the predicted error, pixels. The fit predicts it for the request's own filter, so that another filter's
/// follows from its radius.
double planned_error_px(const ShadowView& view, ShadowFilter own, ShadowFilter filter) {
    if (filter == own || !(view.error.edge_px > 0.0)) return view.error.edge_px;
    const FilterRow& row = filter_row(filter);
    return edge_error_px(view.error.extent_px, static_cast<double>(row.reach_texel - row.still_texel));
}

/// Returns the error in the map as drawn, pixels: with fewer texels than planned, and with earlier casters.
double shown_error_px(const DrawnViews& drawn, std::size_t v, ShadowFilter filter) {
    const MapSettings& map = drawn.request_of(v).map;
    const double planned_px = planned_error_px(drawn.view(v), map.filter, filter);
    const double texels = static_cast<double>(map.resolution_px) / drawn.maps[v].size_px;
    const double own_px = edge_error_px(0.0, 0.0);  // the image's own share
    const double drawn_px = texels > 1.0 ? (planned_px - own_px) * texels + own_px : planned_px;
    return drawn_px + drawn.updates[v].stale.error_px;
}

}  // namespace

ShadowFilter map_filter(const DrawnViews& drawn, std::size_t v) {
    if (!drawn.has_map(v)) return ShadowFilter::automatic;
    const ShadowRequest& request = drawn.request_of(v);
    const bool prefiltered = filter_row(request.map.filter).moments != nullptr;
    return request.rays.used || (prefiltered && !drawn.has_prefiltered(v)) ? kCheapestFilter : request.map.filter;
}

ShadowFilter published_filter(const DrawnViews& drawn, std::uint32_t light, bool rays) {
    const ShadowRequest& request = drawn.lights[light].request;
    if (request.rays.used && rays) return request.map.filter;
    const IndexRange views = drawn.fitted.lights[light].views;
    return views.count > 0 ? map_filter(drawn, views.first) : ShadowFilter::automatic;
}

void add_view(const LightItem& light, const DrawnViews& drawn, std::size_t v, LookupAccuracy& accuracy) {
    if (!drawn.has_map(v) || drawn.view(v).lit) return;
    const BudgetDecision& decision = drawn.lights[drawn.view(v).light];
    accuracy.predicted_error_px = std::max(accuracy.predicted_error_px, shown_error_px(drawn, v, accuracy.filter));
    accuracy.keeps_max_error = drawn.maps[v].size_px >= map_edge_px(decision.request.map) &&
                               decision.refresh_frames == 1 &&
                               meets_target(accuracy.predicted_error_px, target_error_px(light.shadow));
}

}  // namespace gnomon::shadow
