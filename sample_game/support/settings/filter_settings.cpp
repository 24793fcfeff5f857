#include "sample_game/support/settings/filter_settings.h"

#include <array>

#include "sample_game/support/settings/setting_parsers.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/prefilter_settings.h"

namespace gnomon::game {

template <>
inline constexpr std::array<std::string_view, 2> kWords<FilterSeed>{"screen", "world"};

namespace {

constexpr double kSliderSpread_m = 0.5, kSliderDoubles_m = 100.0, kSliderCell_m = 0.25, kSliderSource_m = 0.5,
                 kSliderSun_deg = 3.0;
constexpr double kMostSun_deg = 30.0;  // kMostSunRadius_rad
constexpr double kTexels = static_cast<double>(shadow::kMostSpread_texel);

bool set_filter(LightShadow& shadow, std::string_view text) {
    const shadow::FilterRow* row = shadow::find_filter(text);
    if (!row && text != kAutomatic) return false;
    shadow.filter = row ? row->id : ShadowFilter::automatic;
    return true;
}
std::string get_filter(const LightShadow& shadow) {
    const bool chosen = shadow.filter == ShadowFilter::automatic;
    return std::string(chosen ? kAutomatic : shadow::filter_row(shadow.filter).name);
}
/// `automatic`, then the rows.
std::string_view filter_name(std::size_t index) {
    const auto rows = shadow::filter_table();
    if (index == 0) return kAutomatic;
    return index <= rows.size() ? rows[index - 1].name : std::string_view{};
}

template <std::uint32_t LightShadow::*field, std::uint32_t kMost, std::uint32_t kStep>
bool set_count(LightShadow& shadow, std::string_view text) {
    const auto value = read_count(text);
    if (!value || *value < 1 || *value > kMost || (*value - 1) % kStep != 0) return false;
    shadow.*field = static_cast<std::uint32_t>(*value);
    return true;
}
template <std::uint32_t LightShadow::*field>
std::string get_count(const LightShadow& shadow) {
    return std::to_string(shadow.*field);
}

bool set_spread_texel(LightShadow& shadow, std::string_view text) {
    const auto value = read_number(text);
    return value && *value <= kTexels && set_distance<&LightShadow::filter_spread_texel>(shadow, text);
}
bool set_cell(LightShadow& shadow, std::string_view text) {
    const auto value = read_number(text);
    return value && static_cast<float>(*value) > 0.0f && set_distance<&LightShadow::filter_cell_m>(shadow, text);
}
bool set_moment_bits(LightShadow& shadow, std::string_view text) {
    if (text != "16" && text != "32") return false;
    shadow.moment_bits = text == "16" ? 16 : 32;
    return true;
}
std::string_view moment_bits_word(std::size_t index) {
    constexpr std::array<std::string_view, 2> kBits{"16", "32"};
    return index < kBits.size() ? kBits[index] : std::string_view{};
}
constexpr int kMostExponent = 84;  // of the table, in 32 bits
constexpr int kMostBleedingTenths = static_cast<int>(shadow::kMostMomentBleeding * 10.0f + 0.5f);

bool set_source_radius(LightShadow& shadow, std::string_view text) {
    const auto value = read_number(text);
    return value && *value <= static_cast<double>(kMostSourceRadius_m) &&
           set_distance<&LightShadow::source_radius_m>(shadow, text);
}
bool set_sun_radius(LightShadow& shadow, std::string_view text) {
    const auto value_deg = read_number(text);
    if (!value_deg || !(*value_deg >= 0.0 && *value_deg <= kMostSun_deg)) return false;
    shadow.sun_radius_rad = std::min(static_cast<float>(*value_deg * kDegree_rad), kMostSunRadius_rad);
    return true;
}
using S = LightShadow;
constexpr std::array kSettings{
    LightSetting{.key = "filter",
                 .values = "automatic | a filter, see below",
                 .meaning = "how the map is read; automatic: triangles, or exact where only that keeps max_error_px",
                 .set = set_filter,
                 .get = get_filter,
                 .editor = SettingEditor::choice,
                 .choice = filter_name},
    LightSetting{.key = "filter_size",
                 .values = "1 ... 31, odd",
                 .meaning = "texels along an edge of a pcf filter, or that a prefiltered map is blurred by",
                 .set = set_count<&S::filter_size, shadow::kMostFilterSize, 2>,
                 .get = get_count<&S::filter_size>,
                 .editor = SettingEditor::number,
                 .slider_most = shadow::kMostFilterSize,
                 .whole = true},
    LightSetting{.key = "filter_taps",
                 .values = "1 ... 32",
                 .meaning = "of a poisson filter; at most, of pcss and pcss_moments",
                 .set = set_count<&S::filter_taps, shadow::kMostFilterTaps, 1>,
                 .get = get_count<&S::filter_taps>,
                 .editor = SettingEditor::number,
                 .slider_most = shadow::kMostFilterTaps,
                 .whole = true},
    LightSetting{.key = "filter_spread_texel",
                 .values = "0 ... 16 (texels)",
                 .meaning = "half-width of a poisson or cube filter",
                 .set = set_spread_texel,
                 .get = get_float<&S::filter_spread_texel>,
                 .editor = SettingEditor::number,
                 .slider_most = kTexels},
    LightSetting{.key = "filter_spread_m",
                 .values = "0 ... 1e11 (m)",
                 .meaning = "the same in metres, instead, up to 16 texels; 0: in texels",
                 .set = set_distance<&S::filter_spread_m>,
                 .get = get_float<&S::filter_spread_m>,
                 .editor = SettingEditor::number,
                 .slider_most = kSliderSpread_m},
    LightSetting{.key = "filter_doubles_m",
                 .values = "0 ... 1e11 (m)",
                 .meaning = "distance from the camera at which it has doubled; 0: never",
                 .set = set_distance<&S::filter_doubles_m>,
                 .get = get_float<&S::filter_doubles_m>,
                 .editor = SettingEditor::number,
                 .slider_most = kSliderDoubles_m},
    LightSetting{.key = "filter_seed",
                 .values = "screen | world",
                 .meaning = "what poisson_rotated, _stratified and pcss differ by",
                 .set = set_word<&S::filter_seed, FilterSeed>,
                 .get = get_word<&S::filter_seed, FilterSeed>,
                 .editor = SettingEditor::choice,
                 .choice = word<FilterSeed>},
    LightSetting{.key = "filter_cell_m",
                 .values = "above 0 ... 1e11 (m)",
                 .meaning = "edge of a cell of filter_seed=world",
                 .set = set_cell,
                 .get = get_float<&S::filter_cell_m>,
                 .editor = SettingEditor::number,
                 .slider_most = kSliderCell_m},
    LightSetting{.key = "moment_bits",
                 .values = "16 | 32",
                 .meaning = "of a channel of a prefiltered map",
                 .set = set_moment_bits,
                 .get = get_count<&S::moment_bits>,
                 .editor = SettingEditor::choice,
                 .choice = moment_bits_word},
    LightSetting{.key = "moment_exponent",
                 .values = "0 ... 84",
                 .meaning = "of exponential and evsm; 0: as much as the format bears",
                 .set = set_up_to<&S::moment_exponent, kMostExponent>,
                 .get = get_float<&S::moment_exponent>,
                 .editor = SettingEditor::number,
                 .slider_most = kMostExponent},
    LightSetting{.key = "moment_negative_exponent",
                 .values = "0 ... 84",
                 .meaning = "of evsm4's second warp; 0: 5",
                 .set = set_up_to<&S::moment_negative_exponent, kMostExponent>,
                 .get = get_float<&S::moment_negative_exponent>,
                 .editor = SettingEditor::number,
                 .slider_most = kMostExponent},
    LightSetting{.key = "moment_bleeding",
                 .values = "0 ... 0.9",
                 .meaning = "what a prefiltered map lights less counts as dark",
                 .set = set_up_to<&S::moment_bleeding, kMostBleedingTenths, 10>,
                 .get = get_float<&S::moment_bleeding>,
                 .editor = SettingEditor::number,
                 .slider_most = static_cast<double>(kMostBleedingTenths) / 10.0},
    LightSetting{.key = "moment_levels",
                 .values = "1 ... 4",
                 .meaning = "of mipmaps of a prefiltered map",
                 .set = set_count<&S::moment_levels, shadow::kMostMomentLevels, 1>,
                 .get = get_count<&S::moment_levels>,
                 .editor = SettingEditor::number,
                 .slider_most = shadow::kMostMomentLevels,
                 .whole = true},
    LightSetting{.key = "moment_anisotropy",
                 .values = "1 ... 16",
                 .meaning = "samples along a pixel's footprint in it",
                 .set = set_count<&S::moment_anisotropy, shadow::kMostMomentAnisotropy, 1>,
                 .get = get_count<&S::moment_anisotropy>,
                 .editor = SettingEditor::number,
                 .slider_most = shadow::kMostMomentAnisotropy,
                 .whole = true},
    LightSetting{.key = "source_radius_m",
                 .values = "0 ... 1e4 (m)",
                 .meaning = "radius of a spot's or a point's source, for the pcss filters; 0: a point",
                 .set = set_source_radius,
                 .get = get_float<&S::source_radius_m>,
                 .editor = SettingEditor::number,
                 .slider_most = kSliderSource_m},
    LightSetting{.key = "sun_radius_deg",
                 .values = "0 ... 30 (degrees)",
                 .meaning = "angular radius of a sun's disk, for the pcss filters; the real one's: 0.2665; 0: a point",
                 .set = set_sun_radius,
                 .get = get_degrees<&S::sun_radius_rad>,
                 .editor = SettingEditor::number,
                 .slider_most = kSliderSun_deg},
    LightSetting{.key = "penumbra_rays",
                 .values = "1 ... 256",
                 .meaning = "of exact_soft: rays from each pixel in a penumbra",
                 .set = set_count<&S::penumbra_rays, shadow::kMostPenumbraRays, 1>,
                 .get = get_count<&S::penumbra_rays>,
                 .editor = SettingEditor::number,
                 .slider_most = shadow::kMostPenumbraRays,
                 .whole = true},
    LightSetting{.key = "early_bail",
                 .values = "on | off",
                 .meaning = "five taps first, the others only if those differ",
                 .set = set_switch<&S::early_bail>,
                 .get = get_switch<&S::early_bail>,
                 .editor = SettingEditor::toggle},
};

std::string taps_text(const shadow::FilterRow& row, const LightShadow& shadow) {
    const std::uint32_t flat = row.taps(shadow, false), cube = row.taps(shadow, true);
    std::string text = std::to_string(flat) + (flat == 1 ? " tap" : " taps");
    if (cube != flat) text += ", " + std::to_string(cube) + " of a cube";
    return text;
}

const char* sampler_text(shadow::MapReading reading) {
    if (reading == shadow::MapReading::depths) return "depth, read as it is";
    if (reading == shadow::MapReading::moments) return "moments, linear sampler";
    return reading == shadow::MapReading::compare_linear ? "depth, linear sampler" : "depth, nearest sampler";
}

}  // namespace

std::span<const LightSetting> filter_settings() { return kSettings; }

std::string filter_names() {
    std::string names(kAutomatic);
    for (const shadow::FilterRow& row : shadow::filter_table()) names += " | " + std::string(row.name);
    return names;
}

std::string list_filters() {
    constexpr std::size_t kNameWidth = 20;
    constexpr std::uint32_t kUsualMap_px = 2048;
    std::string text = "Filters (taps and half-width E as the defaults have it):\n";
    for (const shadow::FilterRow& row : shadow::filter_table()) {
        const LightShadow shadow{.filter = row.id};
        std::string name(row.name);
        name.resize(std::max(kNameWidth, name.size()), ' ');
        if (shadow::asks_rays(row)) {
            const bool soft = row.storage == shadow::FilterStorage::soft_sheets;
            text += "  " + name + (soft ? "rays to the source" : "a ray") +
                    " for each pixel of which its map is not certain\n";
            continue;
        }
        text += "  " + name + taps_text(row, shadow) + ", E " +
                number_text(shadow::filter_settings(shadow, kUsualMap_px).widest_texel) + " texels, " +
                sampler_text(row.reading) + "\n";
    }
    return text;
}

}  // namespace gnomon::game
