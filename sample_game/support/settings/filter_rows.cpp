#include <array>

#include "gnomon/shadow_tuning.h"
#include "sample_game/support/settings/setting_parsers.h"
#include "sample_game/support/settings/setting_rows.h"

namespace gnomon::game {

template <>
inline constexpr std::array<std::string_view, 2> kWords<FilterSeed>{"screen", "world"};

namespace {

constexpr double kSliderSpread_m = 0.5, kSliderDoubles_m = 100.0, kSliderCell_m = 0.25;
constexpr int kMostSpread = static_cast<int>(kMostSpread_texel);
constexpr int kMostExponent = 84;  // largest exponent of the table, with 32 bits per channel
constexpr int kMostBleedingTenths = static_cast<int>(kMostMomentBleeding * 10.0f + 0.5f);

using K = ShadowTuning::Kernel;
template <auto field>
using Kernel = Field<&LightSettings::tuning, &ShadowTuning::kernel, field>;

bool set_cell(LightSettings& settings, std::string_view text) {
    const auto value = read_number(text);
    return value && static_cast<float>(*value) > 0.0f && set_distance<Kernel<&K::cell_m>>(settings, text);
}

constexpr std::array kKernelRows{
    LightSetting{.key = "filter_size",
                 .field = "ShadowTuning::kernel.size_texel",
                 .values = "1 ... 31, odd",
                 .meaning = "texels along an edge of a pcf filter, or that a prefiltered map is blurred by",
                 .set = set_count<Kernel<&K::size_texel>, 1, kMostFilterSize, 2>,
                 .get = get_count<Kernel<&K::size_texel>>,
                 .editor = kNumber,
                 .slider_most = kMostFilterSize,
                 .whole = true},
    LightSetting{.key = "filter_taps",
                 .field = "ShadowTuning::kernel.taps",
                 .values = "1 ... 32",
                 .meaning = "of a poisson filter; at most, of pcss",
                 .set = set_count<Kernel<&K::taps>, 1, kMostFilterTaps>,
                 .get = get_count<Kernel<&K::taps>>,
                 .editor = kNumber,
                 .slider_most = kMostFilterTaps,
                 .whole = true},
    LightSetting{.key = "filter_spread_texel",
                 .field = "ShadowTuning::kernel.spread_texel",
                 .values = "0 ... 16 (texels)",
                 .meaning = "half-width of a poisson or cube filter",
                 .set = set_up_to<Kernel<&K::spread_texel>, kMostSpread>,
                 .get = get_float<Kernel<&K::spread_texel>>,
                 .editor = kNumber,
                 .slider_most = kMostSpread},
    LightSetting{.key = "filter_spread_m",
                 .field = "ShadowTuning::kernel.spread_m",
                 .values = "0 ... 1e11 (m)",
                 .meaning = "the same in metres, instead, up to 16 texels; 0: in texels",
                 .set = set_distance<Kernel<&K::spread_m>>,
                 .get = get_float<Kernel<&K::spread_m>>,
                 .editor = kNumber,
                 .slider_most = kSliderSpread_m},
    LightSetting{.key = "filter_doubles_m",
                 .field = "ShadowTuning::kernel.doubles_m",
                 .values = "0 ... 1e11 (m)",
                 .meaning = "distance from the camera at which it has doubled; 0: never",
                 .set = set_distance<Kernel<&K::doubles_m>>,
                 .get = get_float<Kernel<&K::doubles_m>>,
                 .editor = kNumber,
                 .slider_most = kSliderDoubles_m},
    LightSetting{.key = "filter_seed",
                 .field = "ShadowTuning::kernel.seed",
                 .values = "screen | world",
                 .meaning = "what poisson_rotated, _stratified, pcss, soft_triangles and exact_soft differ by",
                 .set = set_word<Kernel<&K::seed>>,
                 .get = get_word<Kernel<&K::seed>>,
                 .editor = kChoice,
                 .choice = word<FilterSeed>},
    LightSetting{.key = "filter_cell_m",
                 .field = "ShadowTuning::kernel.cell_m",
                 .values = "above 0 ... 1e11 (m)",
                 .meaning = "edge of a cell of filter_seed=world",
                 .set = set_cell,
                 .get = get_float<Kernel<&K::cell_m>>,
                 .editor = kNumber,
                 .slider_most = kSliderCell_m},
    LightSetting{.key = "penumbra_rays",
                 .field = "ShadowTuning::kernel.penumbra_rays",
                 .values = "1 ... 256",
                 .meaning = "of exact_soft: rays from each pixel in a penumbra",
                 .set = set_count<Kernel<&K::penumbra_rays>, 1, kMostPenumbraRays>,
                 .get = get_count<Kernel<&K::penumbra_rays>>,
                 .editor = kNumber,
                 .slider_most = kMostPenumbraRays,
                 .whole = true},
    LightSetting{.key = "early_bail",
                 .field = "ShadowTuning::kernel.early_bail",
                 .values = "on | off",
                 .meaning = "five taps first, the others only if those differ",
                 .set = set_switch<Kernel<&K::early_bail>>,
                 .get = get_switch<Kernel<&K::early_bail>>,
                 .editor = kToggle},
};

using M = ShadowTuning::Moments;
template <auto field>
using Moments = Field<&LightSettings::tuning, &ShadowTuning::moments, field>;

bool set_moment_bits(LightSettings& settings, std::string_view text) {
    if (text != "16" && text != "32") return false;
    settings.tuning.moments.bits = text == "16" ? 16 : 32;
    return true;
}
std::string_view moment_bits_word(std::size_t index) {
    constexpr std::array<std::string_view, 2> kBits{"16", "32"};
    return index < kBits.size() ? kBits[index] : std::string_view{};
}

constexpr std::array kMomentsRows{
    LightSetting{.key = "moment_bits",
                 .field = "ShadowTuning::moments.bits",
                 .values = "16 | 32",
                 .meaning = "of a channel of a prefiltered map",
                 .set = set_moment_bits,
                 .get = get_count<Moments<&M::bits>>,
                 .editor = kChoice,
                 .choice = moment_bits_word},
    LightSetting{.key = "moment_exponent",
                 .field = "ShadowTuning::moments.exponent",
                 .values = "0 ... 84",
                 .meaning = "of exponential and evsm; 0: as much as the format bears",
                 .set = set_up_to<Moments<&M::exponent>, kMostExponent>,
                 .get = get_float<Moments<&M::exponent>>,
                 .editor = kNumber,
                 .slider_most = kMostExponent},
    LightSetting{.key = "moment_negative_exponent",
                 .field = "ShadowTuning::moments.negative_exponent",
                 .values = "0 ... 84",
                 .meaning = "of evsm4's second warp; 0: 5",
                 .set = set_up_to<Moments<&M::negative_exponent>, kMostExponent>,
                 .get = get_float<Moments<&M::negative_exponent>>,
                 .editor = kNumber,
                 .slider_most = kMostExponent},
    LightSetting{.key = "moment_bleeding",
                 .field = "ShadowTuning::moments.bleeding",
                 .values = "0 ... 0.9",
                 .meaning = "what a prefiltered map lights less counts as dark",
                 .set = set_up_to<Moments<&M::bleeding>, kMostBleedingTenths, 10>,
                 .get = get_float<Moments<&M::bleeding>>,
                 .editor = kNumber,
                 .slider_most = static_cast<double>(kMostBleedingTenths) / 10.0},
    LightSetting{.key = "moment_levels",
                 .field = "ShadowTuning::moments.levels",
                 .values = "1 ... 4",
                 .meaning = "of mipmaps of a prefiltered map",
                 .set = set_count<Moments<&M::levels>, 1, kMostMomentLevels>,
                 .get = get_count<Moments<&M::levels>>,
                 .editor = kNumber,
                 .slider_most = kMostMomentLevels,
                 .whole = true},
    LightSetting{.key = "moment_anisotropy",
                 .field = "ShadowTuning::moments.anisotropy",
                 .values = "1 ... 16",
                 .meaning = "samples along a pixel's footprint in it",
                 .set = set_count<Moments<&M::anisotropy>, 1, kMostMomentAnisotropy>,
                 .get = get_count<Moments<&M::anisotropy>>,
                 .editor = kNumber,
                 .slider_most = kMostMomentAnisotropy,
                 .whole = true},
};

}  // namespace

std::span<const LightSetting> kernel_rows() { return kKernelRows; }
std::span<const LightSetting> moments_rows() { return kMomentsRows; }

}  // namespace gnomon::game
