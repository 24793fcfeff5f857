#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/types.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {

/// The filter that the light of this demand is published with. `slot`: of any of its views; `rays`: what rays walk is
/// on the device. automatic: none, it is lit.
ShadowFilter published_filter(const ShadowDemand& demand, const ShadowSlot& slot, bool rays);

/// Raises what is said of a light by a view that `accuracy.filter` looks up in its map. A view that is lit, or has no
/// map, says nothing.
void add_view(const LightItem& light, const ShadowDemand& demand, const ShadowView& view, const ShadowSlot& slot,
              LookupAccuracy& accuracy);

}  // namespace gnomon::shadow
