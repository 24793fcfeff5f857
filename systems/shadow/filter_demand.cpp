#include "systems/shadow/filter_demand.h"

#include <algorithm>
#include <cmath>

#include "systems/shadow/filter_table.h"

namespace gnomon::shadow {
namespace {

/// Of a map's edge: a wider footprint would leave too little between its borders.
constexpr std::uint32_t kEdgesPerSpread = 8;

bool is_length(float value) { return std::isfinite(value) && value >= 0.0f; }

}  // namespace

FilterDemand filter_demand(const LightShadow& shadow, std::uint32_t resolution_px) {
    return filter_demand(filter_row(shadow.filter), shadow, resolution_px);
}

FilterDemand filter_demand(const FilterRow& row, const LightShadow& shadow, std::uint32_t resolution_px) {
    const float most_texel = std::min(kMostSpread_texel, static_cast<float>(resolution_px / kEdgesPerSpread));
    FilterDemand filter;
    filter.reach_texel = row.reach_texel;
    if (row.width == FilterWidth::size) {
        // The nearest odd size below.
        const auto most = std::min(kMostFilterSize, 2 * static_cast<std::uint32_t>(most_texel) + 1);
        filter.size = (std::clamp(shadow.filter_size, 1u, most) - 1) / 2 * 2 + 1;
        filter.cut = filter.size != shadow.filter_size;
        filter.reach_texel += 0.5f * static_cast<float>(filter.size - 1);
    }
    filter.widest_texel = filter.reach_texel;
    filter.still_texel = row.still_texel;
    if (row.width == FilterWidth::spread) {
        const LightShadow usual;
        const auto valid = [&](float LightShadow::*field) {
            const bool good = is_length(shadow.*field);
            filter.cut = filter.cut || !good;
            return good ? shadow.*field : usual.*field;
        };
        filter.taps = std::clamp(shadow.filter_taps, 1u, kMostFilterTaps);
        filter.spread_m = valid(&LightShadow::filter_spread_m);
        filter.doubles_m = valid(&LightShadow::filter_doubles_m);
        const float spread_texel = valid(&LightShadow::filter_spread_texel);
        filter.cell_m = valid(&LightShadow::filter_cell_m);
        if (!(filter.cell_m > 0.0f)) filter.cell_m = usual.filter_cell_m;
        filter.spread_texel = std::min(spread_texel, most_texel);
        filter.cut = filter.cut || filter.taps != shadow.filter_taps || filter.cell_m != shadow.filter_cell_m ||
                     (filter.spread_m == 0.0f && filter.spread_texel != spread_texel);
        const bool varies = filter.spread_m > 0.0f || filter.doubles_m > 0.0f;
        filter.most_spread_texel = varies ? most_texel : filter.spread_texel;
        filter.widest_texel += filter.most_spread_texel;
    }
    return filter;
}

double reach_texel_at(const FilterDemand& filter, double texel_m) {
    if (!(filter.spread_m > 0.0f) || filter.doubles_m > 0.0f) return static_cast<double>(filter.widest_texel);
    const double spread_texel = static_cast<double>(filter.spread_m) / texel_m;
    const auto most_texel = static_cast<double>(filter.most_spread_texel);
    // Not a finite number: the widest.
    return static_cast<double>(filter.reach_texel) + (spread_texel < most_texel ? spread_texel : most_texel);
}

double edge_texel_at(const FilterDemand& filter, double texel_m) {
    return reach_texel_at(filter, texel_m) - static_cast<double>(filter.still_texel);
}

}  // namespace gnomon::shadow
