#include "systems/shadow/request/prefilter_settings.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

static_assert(kMomentWeights == kMostFilterSize / 2 + 1);
constexpr float kCutOff_deviations = 2.0f;

/// 0 asks for the usual one.
float exponent(float asked, float usual, float most, bool& cut) {
    if (asked == 0.0f || most == 0.0f) return std::min(usual, most);
    const bool good = asked > 0.0f && asked <= most;
    cut = cut || !good;
    if (good) return asked;
    return asked > most ? most : std::min(usual, most);  // not a number: the usual one
}

/// Footprints of more texels would ask for more border and bias than they are worth.
constexpr float kMostFootprint_texel = 16.0f;

/// A sampler's blend at the coarsest level reads texels up to one and a half of its own away, of which E has one of the
/// finest already; anisotropy moves it along the footprint, by half of it.
void set_footprint(MomentDemand& demand) {
    const auto coarsest_texel = static_cast<float>(1u << (demand.levels - 1));
    demand.footprint_texel = std::min(coarsest_texel * static_cast<float>(demand.anisotropy), kMostFootprint_texel);
    demand.reach_texel = demand.levels > 1 ? 1.5f * coarsest_texel - 1.0f : 0.0f;
    if (demand.anisotropy > 1) demand.reach_texel += 0.5f * demand.footprint_texel;
}

/// Of FilterWidth::source, as filter_demand() takes its size.
std::uint32_t penumbra_levels(const FilterRow& row, const LightItem& light, std::uint32_t resolution_px) {
    const float size = source_size(light);
    const bool soft = row.width == FilterWidth::source && std::isfinite(size) && size > 0.0f;
    if (!soft) return 1;
    const auto most_texel = static_cast<float>(resolution_px / kEdgesPerSpread);
    return widest_penumbra_levels(std::min(kMostPenumbra_texel, most_texel));
}

}  // namespace

std::uint32_t widest_penumbra_levels(float radius_texel) {
    return static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint32_t>(std::max(radius_texel, 1.0f))));
}

MomentDemand moment_demand(const FilterRow& row, const LightItem& light, std::uint32_t resolution_px) {
    MomentDemand demand;
    if (!row.moments) return demand;
    const ShadowTuning::Moments& tuning = light.tuning.moments;
    const bool half = tuning.bits <= 16;
    const MomentStore& store = half ? row.moments->bits_16 : row.moments->bits_32;
    demand.cut = tuning.bits != 16 && tuning.bits != 32;
    demand.format = store.format;
    const float negative = row.moments->usual_negative_exponent;
    demand.settings = {
        exponent(tuning.exponent, store.usual_exponent, store.most_exponent, demand.cut),
        negative > 0.0f ? exponent(tuning.negative_exponent, negative, store.most_exponent, demand.cut) : 0.0f,
        store.least, half ? 1.0f : 0.0f};
    const bool share = tuning.bleeding >= 0.0f && tuning.bleeding <= kMostMomentBleeding;
    demand.bleeding = share ? tuning.bleeding : ShadowTuning::Moments{}.bleeding;
    demand.levels = std::clamp(tuning.levels, 1u, kMostMomentLevels);
    demand.anisotropy = std::clamp(tuning.anisotropy, 1u, kMostMomentAnisotropy);
    set_footprint(demand);
    const auto most_texel = static_cast<float>(resolution_px / kEdgesPerSpread);
    while (demand.reach_texel > most_texel && demand.levels + demand.anisotropy > 2) {
        (demand.levels > 1 ? demand.levels : demand.anisotropy) -= 1;
        set_footprint(demand);
    }
    demand.cut = demand.cut || !share || demand.levels != tuning.levels || demand.anisotropy != tuning.anisotropy;
    demand.levels = std::max(demand.levels, penumbra_levels(row, light, resolution_px));
    return demand;
}

std::array<float, kMomentWeights> blur_weights(std::uint32_t size) {
    std::array<float, kMomentWeights> weights{};
    const std::uint32_t radius = std::min(size / 2, kMomentWeights - 1);
    const float deviation_texel = (static_cast<float>(radius) + 0.5f) / kCutOff_deviations;
    float sum = 0.0f;
    for (std::uint32_t i = 0; i <= radius; ++i) {
        const float away = static_cast<float>(i) / deviation_texel;
        weights[i] = std::exp(-0.5f * away * away);
        sum += i == 0 ? weights[i] : 2.0f * weights[i];
    }
    for (float& weight : weights) weight /= sum;
    return weights;
}

}  // namespace gnomon::shadow
