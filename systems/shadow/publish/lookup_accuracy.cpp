#include "systems/shadow/publish/lookup_accuracy.h"

#include <algorithm>

#include "systems/shadow/fitting/error_bound.h"
#include "systems/shadow/request/accuracy_target.h"

namespace gnomon::shadow {
namespace {

/// What the fit predicts, which it does for the demand's own filter.
double planned_error_px(const ShadowView& view, const ShadowDemand& demand, ShadowFilter filter) {
    if (filter == demand.filter || !(view.predicted_error_px > 0.0)) return view.predicted_error_px;
    const FilterRow& row = filter_row(filter);
    return edge_error_px(view.texel_extent_px, static_cast<double>(row.reach_texel - row.still_texel));
}

/// The same in a map of fewer texels than planned, of casters as they were when it was drawn.
double shown_error_px(const ShadowView& view, const ShadowDemand& demand, const ShadowSlot& slot, ShadowFilter filter) {
    const double planned_px = planned_error_px(view, demand, filter);
    const double texels = static_cast<double>(demand.resolution_px) / slot.size_px;
    const double own_px = edge_error_px(0.0, 0.0);  // the picture's
    const double drawn_px = texels > 1.0 ? (planned_px - own_px) * texels + own_px : planned_px;
    return drawn_px + slot.stale.error_px;
}

}  // namespace

ShadowFilter published_filter(const ShadowDemand& demand, const ShadowSlot& slot, bool rays) {
    if (demand.asks_rays && rays) return demand.filter;
    if (!slot.texture) return ShadowFilter::automatic;
    const bool prefiltered = filter_row(demand.filter).storage == FilterStorage::moments;
    return demand.asks_rays || (prefiltered && !slot.moments) ? kPlainFilter : demand.filter;
}

void add_view(const LightItem& light, const ShadowDemand& demand, const ShadowView& view, const ShadowSlot& slot,
              LookupAccuracy& accuracy) {
    if (!slot.texture || view.lit) return;
    accuracy.predicted_error_px =
        std::max(accuracy.predicted_error_px, shown_error_px(view, demand, slot, accuracy.filter));
    accuracy.keeps_max_error = slot.size_px >= map_edge_px(demand) && demand.refresh_frames == 1 &&
                               keeps_contract(accuracy.predicted_error_px, wished_error_px(light.shadow));
}

}  // namespace gnomon::shadow
