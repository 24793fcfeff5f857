#include <algorithm>
#include <array>

#include "gnomon/light.h"
#include "sample_game/support/settings/filter_settings.h"
#include "sample_game/support/settings/setting_parsers.h"
#include "sample_game/support/settings/setting_rows.h"

namespace gnomon::game {

template <>
inline constexpr std::array<std::string_view, 4> kWords<CasterFaces>{"automatic", "front", "back", "both"};

namespace {

// Larger than any texture OpenGL devices make; the shadow system clamps to the device's own limit and reports it.
constexpr std::uint32_t kMaxResolution_px = 65536;
constexpr double kMaxError_px = 1.0e4;
constexpr double kSliderResolution_px = 4096.0, kSliderError_px = 16.0, kSliderSource_m = 0.5, kSliderSun_deg = 3.0;
constexpr double kSliderSide_m = 4.0;
constexpr double kMostSun_deg = 30.0;  // kMostSunRadius_rad

bool set_max_error(LightSettings& settings, std::string_view text) {
    float& error_px = settings.shadow.max_error_px;
    if (text == kAutomatic) error_px = 0.0f;
    if (text == kAutomatic) return true;
    const auto value = read_number(text);
    if (!value || !(static_cast<float>(*value) > 0.0f && *value <= kMaxError_px)) return false;
    error_px = static_cast<float>(*value);
    return true;
}

std::string get_max_error(const LightSettings& settings) {
    const float error_px = settings.shadow.max_error_px;
    return error_px > 0.0f ? number_text(error_px) : std::string(kAutomatic);
}

bool set_sun_radius(LightSettings& settings, std::string_view text) {
    const auto value_deg = read_number(text);
    if (!value_deg || !(*value_deg >= 0.0 && *value_deg <= kMostSun_deg)) return false;
    settings.sun_radius_rad = std::min(static_cast<float>(*value_deg * kDegree_rad), kMostSunRadius_rad);
    return true;
}

using S = LightShadow;
template <auto field>
using Shadow = Field<&LightSettings::shadow, field>;
constexpr std::array kShadowRows{
    LightSetting{.key = "enabled",
                 .field = "LightShadow::enabled",
                 .values = "on | off",
                 .meaning = "whether the light casts shadows",
                 .set = set_switch<Shadow<&S::enabled>>,
                 .get = get_switch<Shadow<&S::enabled>>,
                 .editor = kToggle},
    LightSetting{
        .key = "filter",
        .field = "LightShadow::filter",
        .values = "automatic | a filter, see below",
        .meaning = "how the map is read; automatic: triangles, or exact where only that meets the targets below",
        .set = set_filter,
        .get = get_filter,
        .editor = kChoice,
        .choice = filter_name},
    LightSetting{.key = "antialias",
                 .field = "LightShadow::antialias",
                 .values = "on | off",
                 .meaning = "edges: the lit share of a pixel, not lit or dark by its middle",
                 .set = set_switch<Shadow<&S::antialias>>,
                 .get = get_switch<Shadow<&S::antialias>>,
                 .editor = kToggle},
    LightSetting{.key = "max_error_px",
                 .field = "LightShadow::max_error_px",
                 .values = "automatic | above 0 ... 10000 (px)",
                 .meaning = "how far a shadow edge may be off on screen; automatic: 1, as far as usual maps keep it",
                 .set = set_max_error,
                 .get = get_max_error,
                 .editor = kNumber,
                 .slider_most = kSliderError_px},
    LightSetting{.key = "narrowest_caster_px",
                 .field = "LightShadow::narrowest_caster_px",
                 .values = "0 ... 10000 (px)",
                 .meaning = "width of the narrowest caster that must count, on screen at its receiver; 0: any",
                 .set = set_up_to<Shadow<&S::narrowest_caster_px>, 10000>,
                 .get = get_float<Shadow<&S::narrowest_caster_px>>,
                 .editor = kNumber,
                 .slider_most = kSliderError_px},
    LightSetting{.key = "resolution",
                 .field = "LightShadow::resolution_px",
                 .values = "0 ... 65536 (px)",
                 .meaning = "edge of one map or cube face; 0: chosen by the system",
                 .set = set_count<Shadow<&S::resolution_px>, 0, kMaxResolution_px>,
                 .get = get_count<Shadow<&S::resolution_px>>,
                 .editor = kNumber,
                 .slider_most = kSliderResolution_px,
                 .whole = true},
    LightSetting{.key = "cascades",
                 .field = "LightShadow::cascades",
                 .values = "0 ... 8",
                 .meaning = "of a sun; 0: one, two or four, as few as serve",
                 .set = set_count<Shadow<&S::cascades>, 0, kMaxCascades>,
                 .get = get_count<Shadow<&S::cascades>>,
                 .editor = kNumber,
                 .slider_most = kMaxCascades,
                 .whole = true},
    LightSetting{.key = "refresh_error_px",
                 .field = "LightShadow::refresh_error_px",
                 .values = "0 ... 100 (px)",
                 .meaning = "how much farther off it may be instead of drawing again what moves; 0: not",
                 .set = set_up_to<Shadow<&S::refresh_error_px>, 100>,
                 .get = get_float<Shadow<&S::refresh_error_px>>,
                 .editor = kNumber,
                 .slider_most = kSliderError_px},
    LightSetting{.key = "caster_faces",
                 .field = "LightShadow::caster_faces",
                 .values = "automatic | front | back | both",
                 .meaning = "which faces of closed casters are drawn; of all others both",
                 .set = set_word<Shadow<&S::caster_faces>>,
                 .get = get_word<Shadow<&S::caster_faces>>,
                 .editor = kChoice,
                 .choice = word<CasterFaces>},
    LightSetting{.key = "layers",
                 .field = "LightShadow::layers",
                 .values = "0 ... 255",
                 .meaning = "a bit per layer: casters and receivers that share none cast and take no shadow",
                 .set = set_count<Shadow<&S::layers>, 0, kAllShadowLayers>,
                 .get = get_count<Shadow<&S::layers>>,
                 .editor = kNumber,
                 .slider_most = kAllShadowLayers,
                 .whole = true},
    LightSetting{.key = "translucent_casters",
                 .field = "LightShadow::translucent_casters",
                 .values = "on | off",
                 .meaning = "glass and blended casters tint the light that passes; off: they cast nothing",
                 .set = set_switch<Shadow<&S::translucent_casters>>,
                 .get = get_switch<Shadow<&S::translucent_casters>>,
                 .editor = kToggle},
};

constexpr std::array kSizeRows{
    LightSetting{.key = "source_radius_m",
                 .field = "Light::source_radius_m",
                 .values = "0 ... 1e4 (m)",
                 .meaning = "radius of a lamp's source; 0: a point, or no light from a disc, sphere or tube",
                 .set = set_up_to<Field<&LightSettings::source_radius_m>, static_cast<int>(kMostSourceRadius_m)>,
                 .get = get_float<Field<&LightSettings::source_radius_m>>,
                 .editor = kNumber,
                 .slider_most = kSliderSource_m},
    LightSetting{.key = "source_width_m",
                 .field = "Light::width_m",
                 .values = "above 0 ... 2e4 (m)",
                 .meaning = "width of a rectangle, or length of a tube",
                 .set = set_up_to<Field<&LightSettings::width_m>, 2 * static_cast<int>(kMostSourceRadius_m)>,
                 .get = get_float<Field<&LightSettings::width_m>>,
                 .editor = kNumber,
                 .slider_most = kSliderSide_m},
    LightSetting{.key = "source_height_m",
                 .field = "Light::height_m",
                 .values = "above 0 ... 2e4 (m)",
                 .meaning = "height of a rectangle",
                 .set = set_up_to<Field<&LightSettings::height_m>, 2 * static_cast<int>(kMostSourceRadius_m)>,
                 .get = get_float<Field<&LightSettings::height_m>>,
                 .editor = kNumber,
                 .slider_most = kSliderSide_m},
    LightSetting{.key = "sun_radius_deg",
                 .field = "Light::sun_radius_rad",
                 .values = "0 ... 30 (degrees)",
                 .meaning = "angular radius of a sun's disk; the real one's: 0.2665; 0: a point",
                 .set = set_sun_radius,
                 .get = get_degrees<Field<&LightSettings::sun_radius_rad>>,
                 .editor = kNumber,
                 .slider_most = kSliderSun_deg},
};

}  // namespace

std::span<const LightSetting> shadow_rows() { return kShadowRows; }
std::span<const LightSetting> size_rows() { return kSizeRows; }

}  // namespace gnomon::game
