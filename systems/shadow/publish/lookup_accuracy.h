#pragma once
#include <cstddef>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/frame/lighting_inputs.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {

/// Returns the filter that reads the map of view `v`, by itself. automatic: the view has no map.
ShadowFilter map_filter(const DrawnViews& drawn, std::size_t v);

/// Returns the filter that the light is published with. `rays`: what rays walk is on the device. automatic: none, it is
/// lit.
ShadowFilter published_filter(const DrawnViews& drawn, std::uint32_t light, bool rays);

/// Raises what is said of a light by view `v`, which `accuracy.filter` looks up in its map. A view that is lit, or has
/// no map, says nothing.
void add_view(const LightItem& light, const DrawnViews& drawn, std::size_t v, LookupAccuracy& accuracy);

}  // namespace gnomon::shadow
