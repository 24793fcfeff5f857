#pragma once
#include <cstddef>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/frame/lighting_inputs.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {

/// Returns the filter that reads the map of view `v`, by itself. automatic: the view has no map.
ShadowFilter map_filter(const DrawnViews& drawn, std::size_t v);

/// Returns the filter that the light is published with. `rays`: the casters' trees are on the device. automatic: no
/// filter, the light is unshadowed.
ShadowFilter published_filter(const DrawnViews& drawn, std::uint32_t light, bool rays);

/// Raises a light's published error to that of view `v`, looked up with `accuracy.filter`. A lit view, or a view
/// without a map, changes nothing.
void add_view(const LightItem& light, const DrawnViews& drawn, std::size_t v, LookupAccuracy& accuracy);

}  // namespace gnomon::shadow
