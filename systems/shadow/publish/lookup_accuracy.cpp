#include "systems/shadow/publish/lookup_accuracy.h"

#include <algorithm>

#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/request/accuracy_target.h"

namespace gnomon::shadow {
namespace {

/// Returns the view as another filter reads it. The fit states its errors for the request's own filter, so that
/// another's follow from its radius.
ShadowView read_by(const ShadowView& view, ShadowFilter own, ShadowFilter filter) {
    ShadowView read = view;
    if (filter == own || !(view.error.texel_edge_px > 0.0)) return read;
    const FilterRow& row = filter_row(filter);
    const auto reach_texel = static_cast<double>(row.reach_texel - row.still_texel);
    read.error.texel_edge_px = edge_error_px(view.error.extent_px, reach_texel);
    read.error.resolved_m = resolved_width_texel(reach_texel) * view.error.texel_m;
    state_edges(false, read);
    return read;
}

/// Returns the view with texels that are `times` as large.
ShadowView coarsened(const ShadowView& view, double times) {
    ShadowView coarse = view;
    ViewError& error = coarse.error;
    const bool walks = error.grid_px == 0.0;
    const double grid_px = edge_error_px(0.0, 0.0);
    error.extent_px *= times;
    error.resolved_m *= times;
    if (error.texel_edge_px > 0.0) error.texel_edge_px = (error.texel_edge_px - grid_px) * times + grid_px;
    state_edges(walks, coarse);
    return coarse;
}

/// Returns the view as its map was drawn: with fewer texels than planned, perhaps.
ShadowView as_drawn(const DrawnViews& drawn, std::size_t v, ShadowFilter filter) {
    const MapSettings& map = drawn.request_of(v).map;
    const ShadowView view = read_by(drawn.view(v), map.filter, filter);
    const double texels = static_cast<double>(map.resolution_px) / drawn.maps[v].size_px;
    return texels > 1.0 ? coarsened(view, texels) : view;
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
    const ShadowView view = as_drawn(drawn, v, accuracy.filter);
    const MapAccuracy maps = accuracy_of(view);
    const double edge_px = maps.edge_px + drawn.updates[v].stale.error_px;
    const AccuracyTargets targets = targets_of(light.shadow);
    const bool is_first = !(accuracy.predicted_error_px > 0.0);
    const bool as_granted = drawn.maps[v].size_px >= map_edge_px(decision.request.map) && decision.refresh_frames == 1;
    accuracy.predicted_error_px = std::max(accuracy.predicted_error_px, edge_px);
    accuracy.keeps_max_error = (is_first || accuracy.keeps_max_error) && as_granted &&
                               meets_targets({edge_px, maps.grid_px, 0.0}, {target_error_px(light.shadow), 0.0});
    accuracy.resolved.px = std::max(accuracy.resolved.px, maps.resolved_px);
    accuracy.resolved.m = std::max(accuracy.resolved.m, view.error.resolved_m);
    accuracy.resolved.keeps_narrowest = (is_first || accuracy.resolved.keeps_narrowest) && as_granted &&
                                        meets_targets(maps, {0.0, targets.narrowest_px});
}

}  // namespace gnomon::shadow
