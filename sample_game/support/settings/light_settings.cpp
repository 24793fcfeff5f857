#include "sample_game/support/settings/light_settings.h"

#include <algorithm>
#include <array>
#include <vector>

#include "sample_game/support/settings/filter_settings.h"
#include "sample_game/support/settings/setting_parsers.h"

namespace gnomon::game {
namespace {

using S = LightShadow;
constexpr auto kToggle = SettingEditor::toggle;
constexpr auto kChoice = SettingEditor::choice;
constexpr auto kNumber = SettingEditor::number;
constexpr auto kText = SettingEditor::text;

constexpr std::array kSettings{
    LightSetting{.key = "enabled",
                 .values = "on | off",
                 .meaning = "whether the light casts shadows",
                 .set = set_switch<&S::enabled>,
                 .get = get_switch<&S::enabled>,
                 .editor = kToggle},
    LightSetting{.key = "resolution",
                 .values = "0 ... 65536 (px)",
                 .meaning = "edge of one map or cube face; 0: chosen by the system",
                 .set = set_resolution,
                 .get = get_resolution,
                 .editor = kNumber,
                 .slider_most = kSliderResolution_px,
                 .whole = true},
    LightSetting{.key = "max_error_px",
                 .values = "automatic | above 0 ... 10000 (px)",
                 .meaning = "how far a shadow edge may be off on screen; automatic: 1, as far as usual maps keep it",
                 .set = set_max_error,
                 .get = get_max_error,
                 .editor = kNumber,
                 .slider_most = kSliderError_px},
    LightSetting{.key = "refresh_error_px",
                 .values = "0 ... 100 (px)",
                 .meaning = "how much farther off it may be instead of drawing again what moves; 0: not",
                 .set = set_up_to<&S::refresh_error_px, 100>,
                 .get = get_float<&S::refresh_error_px>,
                 .editor = kNumber,
                 .slider_most = kSliderError_px},
    LightSetting{.key = "bias",
                 .values = "automatic | constant | slope | normal_offset | receiver_plane | tutorial_constant | "
                           "tutorial_cosine | tutorial_tangent | 0 ... 1e6 (m)",
                 .meaning = "offset against self-shadowing; metres: constant",
                 .set = set_bias,
                 .get = get_word<&S::bias, BiasMode>,
                 .editor = kChoice,
                 .choice = word<BiasMode>},
    LightSetting{.key = "bias_m",
                 .values = "0 ... 1e6 (m)",
                 .meaning = "of constant, slope, normal_offset, receiver_plane: along the light",
                 .set = set_up_to<&S::bias_m, kMaxBias>,
                 .get = get_float<&S::bias_m>,
                 .editor = kNumber,
                 .slider_most = kSliderBias_m},
    LightSetting{.key = "bias_texel",
                 .values = "0 ... 1e6 (texels)",
                 .meaning = "of slope, normal_offset, receiver_plane: times tangent or sine of the incidence",
                 .set = set_up_to<&S::bias_texel, kMaxBias>,
                 .get = get_float<&S::bias_texel>,
                 .editor = kNumber,
                 .slider_most = kSliderBias_texel},
    LightSetting{.key = "projection",
                 .values = "automatic | orthographic | perspective",
                 .meaning = "of the map; perspective gives a sun one view from an eye",
                 .set = set_word<&S::projection, LightProjection>,
                 .get = get_word<&S::projection, LightProjection>,
                 .editor = kChoice,
                 .choice = word<LightProjection>},
    LightSetting{.key = "eye_distance_m",
                 .values = "0 ... 1e11 (m)",
                 .meaning = "a sun's eye from the middle of what is seen; 0: the angle holds all that is seen",
                 .set = set_distance<&S::eye_distance_m>,
                 .get = get_float<&S::eye_distance_m>,
                 .editor = kNumber,
                 .slider_most = kSliderDistance_m},
    LightSetting{.key = "eye_angle_deg",
                 .values = "above 0 ... 160 (degrees)",
                 .meaning = "full opening angle of a sun's perspective view",
                 .set = set_eye_angle,
                 .get = get_degrees<&S::eye_angle_rad>,
                 .editor = kNumber,
                 .slider_most = kMaxEyeAngle_deg},
    LightSetting{.key = "near_m",
                 .values = "0 ... 1e11 (m)",
                 .meaning = "depth range starts here, from the light or a sun's eye; 0: fitted",
                 .set = set_distance<&S::near_m>,
                 .get = get_float<&S::near_m>,
                 .editor = kNumber,
                 .slider_most = kSliderDistance_m},
    LightSetting{.key = "far_m",
                 .values = "0 ... 1e11 (m)",
                 .meaning = "depth range ends here; beyond it is lit; 0: fitted",
                 .set = set_distance<&S::far_m>,
                 .get = get_float<&S::far_m>,
                 .editor = kNumber,
                 .slider_most = kSliderDistance_m},
    LightSetting{.key = "cube_route",
                 .values = "automatic | six_passes | layered_vertex | layered_geometry",
                 .meaning = "how a point light's faces are drawn; the maps are the same",
                 .set = set_word<&S::cube_route, CubeRoute>,
                 .get = get_word<&S::cube_route, CubeRoute>,
                 .editor = kChoice,
                 .choice = word<CubeRoute>},
    LightSetting{.key = "depth_format",
                 .values = "d32f | d24 | d16",
                 .meaning = "how a map stores depth: float, or fixed point in 24 or 16 bits",
                 .set = set_word<&S::depth_format, DepthFormat>,
                 .get = get_word<&S::depth_format, DepthFormat>,
                 .editor = kChoice,
                 .choice = word<DepthFormat>},
    LightSetting{.key = "fit",
                 .values = "tight | stable | quantised",
                 .meaning = "how a sun's cascades follow the camera",
                 .set = set_word<&S::fit, ShadowFit>,
                 .get = get_word<&S::fit, ShadowFit>,
                 .editor = kChoice,
                 .choice = word<ShadowFit>},
    LightSetting{.key = "cascades",
                 .values = "0 ... 8",
                 .meaning = "of a sun; 0: four, or fewer that keep max_error_px",
                 .set = set_cascades,
                 .get = get_cascades,
                 .editor = kNumber,
                 .slider_most = kMaxCascades,
                 .whole = true},
    LightSetting{.key = "splits",
                 .values = "practical | uniform | logarithmic | manual | seen | sampled",
                 .meaning = "where a sun's cascades end along the view",
                 .set = set_word<&S::splits, CascadeSplits>,
                 .get = get_word<&S::splits, CascadeSplits>,
                 .editor = kChoice,
                 .choice = word<CascadeSplits>},
    LightSetting{.key = "split_lambda",
                 .values = "0 ... 1",
                 .meaning = "practical, seen and sampled splits: 0 uniform, 1 logarithmic",
                 .set = set_up_to<&S::split_lambda, 100, 100>,
                 .get = get_float<&S::split_lambda>,
                 .editor = kNumber,
                 .slider_most = 1.0},
    LightSetting{.key = "split_m",
                 .values = "0 | up to 7 rising distances, as 5,15,40 (m)",
                 .meaning = "manual splits: one cascade more than distances",
                 .set = set_splits_m,
                 .get = get_splits_m,
                 .editor = kText},
    LightSetting{.key = "cascade_blend",
                 .values = "0 ... 0.5",
                 .meaning = "share of a cascade that fades into the next one",
                 .set = set_up_to<&S::cascade_blend, 50, 100>,
                 .get = get_float<&S::cascade_blend>,
                 .editor = kNumber,
                 .slider_most = 0.5},
    LightSetting{.key = "warp",
                 .values = "0 ... 1",
                 .meaning = "tight fit: how far texels may grow with the distance from the camera",
                 .set = set_up_to<&S::warp, 100, 100>,
                 .get = get_float<&S::warp>,
                 .editor = kNumber,
                 .slider_most = 1.0},
    LightSetting{.key = "caster_faces",
                 .values = "automatic | front | back | both",
                 .meaning = "which faces of closed casters are drawn; of all others both",
                 .set = set_word<&S::caster_faces, CasterFaces>,
                 .get = get_word<&S::caster_faces, CasterFaces>,
                 .editor = kChoice,
                 .choice = word<CasterFaces>},
    LightSetting{.key = "layers",
                 .values = "0 ... 255",
                 .meaning = "a bit per layer: casters and receivers that share none cast and take no shadow",
                 .set = set_layers,
                 .get = get_layers,
                 .editor = kNumber,
                 .slider_most = kAllShadowLayers,
                 .whole = true},
    LightSetting{.key = "economy",
                 .values = "on | off",
                 .meaning = "off: redraw every map every frame, change nothing else",
                 .set = set_switch<&S::economy>,
                 .get = get_switch<&S::economy>,
                 .editor = kToggle},
    LightSetting{.key = "keep_visibility",
                 .values = "on | off",
                 .meaning = "what pixels see of the light is kept while nothing changes; the same to the bit",
                 .set = set_switch<&S::keep_visibility>,
                 .get = get_switch<&S::keep_visibility>,
                 .editor = kToggle},
};

Error bad(std::string message, const char* rule) { return {.message = "--set: " + on_one_line(message), .rule = rule}; }

}  // namespace

std::span<const LightSetting> light_settings() {
    static const auto kAll = [] {
        std::vector<LightSetting> all(kSettings.begin(), kSettings.end());
        all.insert(all.begin() + 1, filter_settings().begin(), filter_settings().end());
        return all;
    }();
    return kAll;
}

std::optional<Error> apply_setting(LightShadow& shadow, std::string_view key_value) {
    const std::size_t equals = key_value.find('=');
    const std::string text(key_value);
    if (equals == std::string_view::npos) return bad("'" + text + "' is not KEY=VALUE", "set.syntax");
    const std::string key(key_value.substr(0, equals));
    const auto settings = light_settings();
    const auto row =
        std::find_if(settings.begin(), settings.end(), [&](const LightSetting& s) { return key == s.key; });
    if (row == settings.end()) return bad("unknown key '" + key + "'; --list shows them", "set.key");
    if (!row->set(shadow, key_value.substr(equals + 1))) {
        const std::string allowed = key == "filter" ? filter_names() : row->values;
        return bad("'" + text + "': " + key + " takes " + allowed, "set.value");
    }
    return std::nullopt;
}

std::string list_settings() {
    const LightShadow defaults;
    const auto padded = [](std::string text, std::size_t width) {
        text.resize(std::max(width, text.size()), ' ');
        return text;
    };
    constexpr std::size_t kKeyWidth = 16, kValueWidth = 40;
    std::string text = "Keys of --set KEY=VALUE (for every light with a shadow):\n";
    for (const LightSetting& s : light_settings()) {
        text += "  " + padded(s.key, kKeyWidth) + padded(s.values, kValueWidth) + s.meaning;
        text += " (default: " + s.get(defaults) + ")\n";
    }
    text += list_filters();
    return text;
}

}  // namespace gnomon::game
