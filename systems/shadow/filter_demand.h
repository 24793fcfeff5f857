#pragma once
#include <cstdint>

#include "components/light_shadow.h"

namespace gnomon::shadow {

struct FilterRow;

inline constexpr std::uint32_t kMostFilterSize = 31, kMostFilterTaps = 32, kMostPenumbraRays = 256;
/// Wider filters cost a map more border, and a plane more bias, than they are worth.
inline constexpr float kMostSpread_texel = 16.0f;
/// Half-width of the widest penumbra of FilterWidth::source: wider ones cost its search more taps; take fewer texels.
inline constexpr float kMostPenumbra_texel = 128.0f;

/// Of a map's edge: a wider footprint would leave too little between its borders.
inline constexpr std::uint32_t kEdgesPerSpread = 8;

/// What of a light's filter settings holds: what is absurd is left out, what its map cannot bear is cut.
struct FilterDemand {
    std::uint32_t size = 3, taps = 16;
    /// E without the spread: what a program is compiled with.
    float reach_texel = 0.5f;
    /// In metres where above 0, else in texels; 0 of a filter that has none. Never more than most_spread_texel.
    float spread_m = 0.0f, spread_texel = 0.0f, most_spread_texel = 0.0f;
    float doubles_m = 0.0f;
    float cell_m = 1.0f;
    /// Size of the source: metres, and the tangent of a sun's angular radius. Both 0 of a filter that does not ask.
    float source_radius_m = 0.0f, sun_radius_tan = 0.0f;
    /// Bound on E: what a map's border leaves room for.
    float widest_texel = 0.5f;
    /// What of E cannot move an edge.
    float still_texel = 0.0f;
    /// What a map's border is made for, twice over: for what is read beside a point and for what the bias moves it. Of
    /// a penumbra the first alone, hence half.
    float border_texel = 0.5f;
    bool cut = false;  // not all is as asked for
};

FilterDemand filter_demand(const LightShadow& shadow, std::uint32_t resolution_px);
FilterDemand filter_demand(const FilterRow& row, const LightShadow& shadow, std::uint32_t resolution_px);

/// Whether a map has to hold how far casters truly are, instead of flattening those before its depth range.
bool needs_distances(const FilterDemand& filter);

/// FilterDemand::border_texel where no penumbra is wider than that.
float border_texel(const FilterDemand& filter, float penumbra_texel);

/// Bound on E where no texel is finer than `texel_m` metres.
double reach_texel_at(const FilterDemand& filter, double texel_m);
/// The same of what can move a shadow's edge.
double edge_texel_at(const FilterDemand& filter, double texel_m);

}  // namespace gnomon::shadow
