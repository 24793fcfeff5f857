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

/// Returns the effective exponent, at most `most`. `asked` 0, negative or NaN: `usual`. Sets `cut` if a value other
/// than 0 was replaced.
float exponent(float asked, float usual, float most, bool& cut) {
    if (asked == 0.0f || most == 0.0f) return std::min(usual, most);
    const bool good = asked > 0.0f && asked <= most;
    cut = cut || !good;
    if (good) return asked;
    return asked > most ? most : std::min(usual, most);
}

/// Largest footprint of a pixel, texels. A larger one needs too much border and bias.
constexpr float kMostFootprint_texel = 16.0f;

/// Sets the footprint and the part of E that it adds. At the coarsest level the sampler blends texels up to 1.5 of that
/// level's away; E already includes one of the finest. Anisotropy moves the taps along the footprint, by half of it.
void set_footprint(PrefilterSettings& request) {
    const auto coarsest_texel = static_cast<float>(1u << (request.levels - 1));
    request.footprint_texel = std::min(coarsest_texel * static_cast<float>(request.anisotropy), kMostFootprint_texel);
    request.reach_texel = request.levels > 1 ? 1.5f * coarsest_texel - 1.0f : 0.0f;
    if (request.anisotropy > 1) request.reach_texel += 0.5f * request.footprint_texel;
}

/// Returns the mipmap levels that the widest penumbra needs; 1 without FilterWidth::source or without a source's size.
/// The size has the limits of filter_settings().
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

PrefilterSettings prefilter_settings(const FilterRow& row, const LightItem& light, std::uint32_t resolution_px) {
    PrefilterSettings request;
    if (!row.moments) return request;
    const ShadowTuning::Moments& tuning = light.tuning.moments;
    const bool half = tuning.bits <= 16;
    const MomentStore& store = half ? row.moments->bits_16 : row.moments->bits_32;
    request.cut = tuning.bits != 16 && tuning.bits != 32;
    request.format = store.format;
    const float negative = row.moments->usual_negative_exponent;
    request.settings = {
        exponent(tuning.exponent, store.usual_exponent, store.most_exponent, request.cut),
        negative > 0.0f ? exponent(tuning.negative_exponent, negative, store.most_exponent, request.cut) : 0.0f,
        store.least, half ? 1.0f : 0.0f};
    const bool share = tuning.bleeding >= 0.0f && tuning.bleeding <= kMostMomentBleeding;
    request.bleeding = share ? tuning.bleeding : ShadowTuning::Moments{}.bleeding;
    request.levels = std::clamp(tuning.levels, 1u, kMostMomentLevels);
    request.anisotropy = std::clamp(tuning.anisotropy, 1u, kMostMomentAnisotropy);
    set_footprint(request);
    const auto most_texel = static_cast<float>(resolution_px / kEdgesPerSpread);
    while (request.reach_texel > most_texel && request.levels + request.anisotropy > 2) {
        (request.levels > 1 ? request.levels : request.anisotropy) -= 1;
        set_footprint(request);
    }
    request.cut = request.cut || !share || request.levels != tuning.levels || request.anisotropy != tuning.anisotropy;
    request.levels = std::max(request.levels, penumbra_levels(row, light, resolution_px));
    return request;
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
