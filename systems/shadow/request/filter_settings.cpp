#include "systems/shadow/request/filter_settings.h"

#include <algorithm>
#include <cmath>

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/prefilter_settings.h"

namespace gnomon::shadow {
namespace {

bool is_length(float value) { return std::isfinite(value) && value >= 0.0f; }

using Kernel = ShadowTuning::Kernel;

/// Returns the field, or its default if it is negative or not finite.
float length_of(const Kernel& kernel, float Kernel::*field, FilterSettings& filter) {
    if (is_length(kernel.*field)) return kernel.*field;
    filter.cut = true;
    return Kernel{}.*field;
}

/// Takes the settings of filters with a random pattern of taps.
void take_seeds(const Kernel& kernel, FilterSettings& filter) {
    filter.taps = std::clamp(kernel.taps, 1u, kMostFilterTaps);
    filter.cell_m = length_of(kernel, &Kernel::cell_m, filter);
    if (!(filter.cell_m > 0.0f)) filter.cell_m = Kernel{}.cell_m;
    filter.cut = filter.cut || filter.taps != kernel.taps || filter.cell_m != kernel.cell_m;
}

/// Takes the number of rays of a penumbra in place of the taps.
void take_rays(const Kernel& kernel, FilterSettings& filter) {
    filter.taps = std::clamp(kernel.penumbra_rays, 1u, kMostPenumbraRays);
    filter.cut = filter.cut || filter.taps != kernel.penumbra_rays;
}

void take_spread(const Kernel& kernel, float most_texel, FilterSettings& filter) {
    filter.spread_m = length_of(kernel, &Kernel::spread_m, filter);
    filter.doubles_m = length_of(kernel, &Kernel::doubles_m, filter);
    const float spread_texel = length_of(kernel, &Kernel::spread_texel, filter);
    filter.spread_texel = std::min(spread_texel, most_texel);
    filter.cut = filter.cut || (filter.spread_m == 0.0f && filter.spread_texel != spread_texel);
    const bool varies = filter.spread_m > 0.0f || filter.doubles_m > 0.0f;
    filter.most_spread_texel = varies ? most_texel : filter.spread_texel;
    filter.widest_texel += filter.most_spread_texel;
}

/// Takes the size of the light's source. The width of its penumbra depends on the casters' distances; here it has its
/// upper limit, most_texel.
void take_source(const LightItem& light, float most_texel, FilterSettings& filter) {
    const float size = source_extent(light);
    const LightFacts& facts = light_facts(light.kind);
    const float taken = is_length(size) ? std::min(size, facts.most_source_size) : 0.0f;
    if (facts.parallel)
        filter.sun_radius_tan = std::tan(taken);
    else
        filter.source_radius_m = taken;
    filter.cut = filter.cut || !(taken == size);
    if (!needs_distances(filter)) return;
    filter.most_spread_texel = std::min(kMostPenumbra_texel, most_texel);
    filter.widest_texel += filter.most_spread_texel;
    filter.still_texel += filter.most_spread_texel;  // half of it lies to either side of where a point's edge would be
}

}  // namespace

float border_texel(const FilterSettings& filter, float penumbra_texel) {
    return needs_distances(filter) ? filter.reach_texel + 0.5f * penumbra_texel : filter.widest_texel;
}

bool needs_distances(const FilterSettings& filter) {
    return filter.source_radius_m > 0.0f || filter.sun_radius_tan > 0.0f;
}

FilterSettings filter_settings(const LightItem& light, std::uint32_t resolution_px) {
    return filter_settings(filter_row(light.shadow.filter), light, resolution_px);
}

FilterSettings filter_settings(const FilterRow& row, const LightItem& light, std::uint32_t resolution_px) {
    const Kernel& kernel = light.tuning.kernel;
    const auto most_edge_texel = static_cast<float>(resolution_px / kEdgesPerSpread);
    const float most_texel = std::min(kMostSpread_texel, most_edge_texel);
    FilterSettings filter;
    filter.reach_texel = row.reach_texel;
    if (row.width == FilterWidth::size) {
        // Even sizes become the next smaller odd one.
        const auto most = std::min(kMostFilterSize, 2 * static_cast<std::uint32_t>(most_texel) + 1);
        filter.size = (std::clamp(kernel.size_texel, 1u, most) - 1) / 2 * 2 + 1;
        filter.cut = filter.size != kernel.size_texel;
        filter.reach_texel += 0.5f * static_cast<float>(filter.size - 1);
    }
    filter.reach_texel += prefilter_settings(row, light, resolution_px).reach_texel;
    filter.widest_texel = filter.reach_texel;
    filter.still_texel = row.still_texel;
    if (row.width == FilterWidth::spread || row.width == FilterWidth::source) take_seeds(kernel, filter);
    if (row.width == FilterWidth::spread) take_spread(kernel, most_texel, filter);
    if (row.rays) take_rays(kernel, filter);
    if (row.width == FilterWidth::source) take_source(light, most_edge_texel, filter);
    filter.border_texel = border_texel(filter, filter.most_spread_texel);
    return filter;
}

double reach_texel_at(const FilterSettings& filter, double texel_m) {
    if (!(filter.spread_m > 0.0f) || filter.doubles_m > 0.0f) return static_cast<double>(filter.widest_texel);
    const double spread_texel = static_cast<double>(filter.spread_m) / texel_m;
    const auto most_texel = static_cast<double>(filter.most_spread_texel);
    // NaN and infinity take the widest.
    return static_cast<double>(filter.reach_texel) + (spread_texel < most_texel ? spread_texel : most_texel);
}

double edge_texel_at(const FilterSettings& filter, double texel_m) {
    return reach_texel_at(filter, texel_m) - static_cast<double>(filter.still_texel);
}

}  // namespace gnomon::shadow
