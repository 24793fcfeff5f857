#include "systems/shadow/request/prefilter_settings.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "systems/extract/light_facts.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::shadow {
namespace {

static_assert(kMomentWeights == kMostFilterSize / 2 + 1);
constexpr float kCutOff_deviations = 2.0f;

/// Returns the effective exponent, at most `most`. `requested` 0, negative or NaN: `usual`. Sets `cut` if a value other
/// than 0 was replaced.
float exponent(float requested, float usual, float most, bool& cut) {
    if (requested == 0.0f || most == 0.0f) return std::min(usual, most);
    const bool good = requested > 0.0f && requested <= most;
    cut = cut || !good;
    if (good) return requested;
    return requested > most ? most : std::min(usual, most);
}

/// Largest footprint of a pixel, texels. A larger one needs too much border and bias.
constexpr float kMostFootprint_texel = 16.0f;

/// Sets the footprint and the part of E that it adds. At the coarsest level the sampler blends texels up to 1.5 of that
/// level's away; E already includes one of the finest. Anisotropy moves the taps along the footprint, by half of it.
void set_footprint(PrefilterSettings& result) {
    const auto coarsest_texel = static_cast<float>(1u << (result.levels - 1));
    result.footprint_texel = std::min(coarsest_texel * static_cast<float>(result.anisotropy), kMostFootprint_texel);
    result.reach_texel = result.levels > 1 ? 1.5f * coarsest_texel - 1.0f : 0.0f;
    if (result.anisotropy > 1) result.reach_texel += 0.5f * result.footprint_texel;
}

/// Returns the mipmap levels that the widest penumbra needs; 1 without FilterWidth::source or without a source's size.
/// The size has the limits of filter_settings().
std::uint32_t penumbra_levels(const FilterRow& row, const LightItem& light, std::uint32_t resolution_px) {
    const float size = source_extent(light);
    const bool soft = row.width == FilterWidth::source && std::isfinite(size) && size > 0.0f;
    if (!soft) return 1;
    const auto most_texel = static_cast<float>(resolution_px / kEdgesPerSpread);
    return widest_penumbra_levels(std::min(kMostPenumbra_texel, most_texel));
}

}  // namespace

std::uint32_t widest_penumbra_levels(float radius_texel) {
    return static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint32_t>(std::max(radius_texel, 1.0f))));
}

PrefilterSettings prefilter_settings(const FilterRow& row, const LightItem& light, std::uint32_t resolution_px) {
    PrefilterSettings result;
    if (!row.moments) return result;
    const ShadowTuning::Moments& tuning = light.tuning.moments;
    const bool half = tuning.bits <= 16;
    const MomentStore& store = half ? row.moments->bits_16 : row.moments->bits_32;
    result.cut = tuning.bits != 16 && tuning.bits != 32;
    result.format = store.format;
    const float negative = row.moments->usual_negative_exponent;
    result.settings = {
        exponent(tuning.exponent, store.usual_exponent, store.most_exponent, result.cut),
        negative > 0.0f ? exponent(tuning.negative_exponent, negative, store.most_exponent, result.cut) : 0.0f,
        store.least, half ? 1.0f : 0.0f};
    const bool share = tuning.bleeding >= 0.0f && tuning.bleeding <= kMostMomentBleeding;
    result.bleeding = share ? tuning.bleeding : ShadowTuning::Moments{}.bleeding;
    result.levels = std::clamp(tuning.levels, 1u, kMostMomentLevels);
    result.anisotropy = std::clamp(tuning.anisotropy, 1u, kMostMomentAnisotropy);
    set_footprint(result);
    const auto most_texel = static_cast<float>(resolution_px / kEdgesPerSpread);
    while (result.reach_texel > most_texel && result.levels + result.anisotropy > 2) {
        (result.levels > 1 ? result.levels : result.anisotropy) -= 1;
        set_footprint(result);
    }
    result.cut = result.cut || !share || result.levels != tuning.levels || result.anisotropy != tuning.anisotropy;
    result.levels = std::max(result.levels, penumbra_levels(row, light, resolution_px));
    return result;
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
