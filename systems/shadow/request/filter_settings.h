#pragma once
#include <cstdint>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_request.h"

namespace gnomon::shadow {

struct FilterRow;

inline constexpr std::uint32_t kMostFilterSize = 31, kMostFilterTaps = 32, kMostPenumbraRays = 256;
/// Wider filters cost a map more border, and a plane more bias, than they are worth.
inline constexpr float kMostSpread_texel = 16.0f;
/// Half-width of the widest penumbra of FilterWidth::source: wider ones cost its search more taps; take fewer texels.
inline constexpr float kMostPenumbra_texel = 128.0f;

/// Of a map's edge: a wider footprint would leave too little between its borders.
inline constexpr std::uint32_t kEdgesPerSpread = 8;

/// Of the source's sizes the light's own kind's counts.
FilterSettings filter_settings(const FilterRow& row, const LightItem& light, std::uint32_t resolution_px);
/// The same with the light's own filter.
FilterSettings filter_settings(const LightItem& light, std::uint32_t resolution_px);

/// The size of the light's source: a sun's as an angle, others' in metres. 0 or no length: a point.
float source_size(const LightItem& light);

/// Whether a map has to hold how far casters truly are, instead of flattening those before its depth range.
bool needs_distances(const FilterSettings& filter);

/// FilterSettings::border_texel where no penumbra is wider than that.
float border_texel(const FilterSettings& filter, float penumbra_texel);

/// Bound on E where no texel is finer than `texel_m` metres.
double reach_texel_at(const FilterSettings& filter, double texel_m);
/// The same of what can move a shadow's edge.
double edge_texel_at(const FilterSettings& filter, double texel_m);

}  // namespace gnomon::shadow
