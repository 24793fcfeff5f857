#pragma once
#include <cstdint>

#include "components/light_shadow.h"

namespace gnomon::shadow {

struct FilterRow;

inline constexpr std::uint32_t kMostFilterSize = 31, kMostFilterTaps = 32;
/// Wider filters cost a map more border, and a plane more bias, than they are worth.
inline constexpr float kMostSpread_texel = 16.0f;

/// What of a light's filter settings holds: what is absurd is left out, what its map cannot bear is cut.
struct FilterDemand {
    std::uint32_t size = 3, taps = 16;
    /// E without the spread: what a program is compiled with.
    float reach_texel = 0.5f;
    /// In metres where above 0, else in texels; 0 of a filter that has none. Never more than most_spread_texel.
    float spread_m = 0.0f, spread_texel = 0.0f, most_spread_texel = 0.0f;
    float doubles_m = 0.0f;
    float cell_m = 1.0f;
    /// Bound on E: what a map's border leaves room for.
    float widest_texel = 0.5f;
    /// What of E cannot move an edge.
    float still_texel = 0.0f;
    bool cut = false;  // not all is as asked for
};

FilterDemand filter_demand(const LightShadow& shadow, std::uint32_t resolution_px);
FilterDemand filter_demand(const FilterRow& row, const LightShadow& shadow, std::uint32_t resolution_px);

/// Bound on E where no texel is finer than `texel_m` metres.
double reach_texel_at(const FilterDemand& filter, double texel_m);
/// The same of what can move a shadow's edge.
double edge_texel_at(const FilterDemand& filter, double texel_m);

}  // namespace gnomon::shadow
