#pragma once
#include <cstdint>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"

namespace gnomon::shadow {

struct FilterRow;

/// Largest half-width of a penumbra of FilterWidth::source, texels. A wider one costs the blocker search more taps; a
/// map with fewer texels avoids that.
inline constexpr float kMostPenumbra_texel = 128.0f;

/// Least ratio of a map's edge to the half-width of a footprint. A wider footprint leaves too little room between the
/// map's borders.
inline constexpr std::uint32_t kEdgesPerSpread = 8;

/// Returns the effective settings of a filter for maps with an edge of resolution_px. The size of the source is the
/// angle for a sun, and the radius for other lights.
FilterSettings filter_settings(const FilterRow& row, const LightItem& light, std::uint32_t resolution_px);
/// Returns the effective settings of the light's own filter.
FilterSettings filter_settings(const LightItem& light, std::uint32_t resolution_px);

/// Returns true if the map must contain the true distances of casters. Otherwise casters before its depth range are
/// flattened onto the near plane.
bool needs_distances(const FilterSettings& filter);

/// Returns FilterSettings::border_texel for penumbrae of half-width up to penumbra_texel.
float border_texel(const FilterSettings& filter, float penumbra_texel);

/// Returns an upper bound on E, texels, where no texel is smaller than `texel_m` metres.
double reach_texel_at(const FilterSettings& filter, double texel_m);
/// Returns an upper bound, texels, on the part of E that can move a shadow's edge.
double edge_texel_at(const FilterSettings& filter, double texel_m);

}  // namespace gnomon::shadow
