#include "sample_game/light_settings.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "sample_game/number_text.h"
#include "systems/shadow/filter_table.h"

namespace gnomon::game {
namespace {

// Larger than any texture OpenGL devices make; the shadow system clamps to the device's own limit and reports it.
constexpr std::uint64_t kMaxResolution_px = 65536;
constexpr double kMaxError_px = 1.0e4;
constexpr double kMaxBias_m = 1.0e6;
constexpr double kSliderResolution_px = 4096.0, kSliderError_px = 16.0, kSliderBias_m = 0.2;

std::string number_text(double value) {
    std::array<char, 32> text{};
    const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), result.ptr};
}

std::optional<bool> read_switch(std::string_view text) {
    if (text == "on") return true;
    if (text == "off") return false;
    return std::nullopt;
}
std::string switch_text(bool on) { return on ? "on" : "off"; }

bool set_enabled(LightShadow& shadow, std::string_view text) {
    const auto on = read_switch(text);
    if (on) shadow.enabled = *on;
    return on.has_value();
}

bool set_filter(LightShadow& shadow, std::string_view text) {
    const shadow::FilterRow* row = shadow::find_filter(text);
    if (row) shadow.filter = row->id;
    return row != nullptr;
}
std::string get_filter(const LightShadow& shadow) { return std::string(shadow::filter_row(shadow.filter).name); }

bool set_resolution(LightShadow& shadow, std::string_view text) {
    const auto value = read_count(text);
    if (!value || *value > kMaxResolution_px) return false;
    shadow.resolution_px = static_cast<std::uint32_t>(*value);
    return true;
}

bool set_max_error(LightShadow& shadow, std::string_view text) {
    const auto value = read_number(text);
    if (!value || !(static_cast<float>(*value) > 0.0f && *value <= kMaxError_px)) return false;
    shadow.max_error_px = static_cast<float>(*value);
    return true;
}

bool set_bias(LightShadow& shadow, std::string_view text) {
    if (text == "automatic") {
        shadow.bias = BiasMode::automatic;
        return true;
    }
    const auto value = read_number(text);
    if (!value || !(*value >= 0.0 && *value <= kMaxBias_m)) return false;
    shadow.bias = BiasMode::constant;
    shadow.bias_m = static_cast<float>(*value);
    return true;
}
std::string get_bias(const LightShadow& shadow) {
    return shadow.bias == BiasMode::automatic ? "automatic" : number_text(static_cast<double>(shadow.bias_m));
}

bool set_economy(LightShadow& shadow, std::string_view text) {
    const auto on = read_switch(text);
    if (on) shadow.economy = *on;
    return on.has_value();
}

constexpr std::array kSettings{
    LightSetting{"enabled", "on | off", "whether the light casts shadows", set_enabled,
                 [](const LightShadow& s) { return switch_text(s.enabled); }, SettingEditor::toggle},
    LightSetting{"filter", "a filter, see below", "how the map is read", set_filter, get_filter,
                 SettingEditor::filter},
    LightSetting{"resolution", "0 ... 65536 (px)", "edge of one map or cube face; 0: chosen by the system",
                 set_resolution, [](const LightShadow& s) { return std::to_string(s.resolution_px); },
                 SettingEditor::number, kSliderResolution_px, true},
    LightSetting{"max_error_px", "above 0 ... 10000 (px)", "how far a shadow edge may be off on screen", set_max_error,
                 [](const LightShadow& s) { return number_text(static_cast<double>(s.max_error_px)); }, SettingEditor::number,
                 kSliderError_px},
    LightSetting{"bias", "automatic | 0 ... 1e6 (m)", "offset against self-shadowing; metres along the light", set_bias,
                 get_bias, SettingEditor::number, kSliderBias_m, false, "automatic"},
    LightSetting{"economy", "on | off", "off: redraw every map every frame, change nothing else", set_economy,
                 [](const LightShadow& s) { return switch_text(s.economy); }, SettingEditor::toggle},
};

Error bad(std::string message, const char* rule) { return {.message = "--set: " + on_one_line(message), .rule = rule}; }

}  // namespace

std::span<const LightSetting> light_settings() { return kSettings; }

std::optional<Error> apply_setting(LightShadow& shadow, std::string_view key_value) {
    const std::size_t equals = key_value.find('=');
    const std::string text(key_value);
    if (equals == std::string_view::npos) return bad("'" + text + "' is not KEY=VALUE", "set.syntax");
    const std::string key(key_value.substr(0, equals));
    const auto row =
        std::find_if(kSettings.begin(), kSettings.end(), [&](const LightSetting& s) { return key == s.key; });
    if (row == kSettings.end()) return bad("unknown key '" + key + "'; --list shows them", "set.key");
    if (!row->set(shadow, key_value.substr(equals + 1))) {
        std::string allowed = row->values;
        if (row->set == set_filter) {
            allowed.clear();
            for (const shadow::FilterRow& f : shadow::filter_table())
                allowed += (allowed.empty() ? "" : " | ") + std::string(f.name);
        }
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
    constexpr std::size_t kKeyWidth = 14, kValueWidth = 28;
    std::string text = "Keys of --set KEY=VALUE (for every light with a shadow):\n";
    for (const LightSetting& s : kSettings) {
        text += "  " + padded(s.key, kKeyWidth) + padded(s.values, kValueWidth) + s.meaning;
        text += " (default: " + s.get(defaults) + ")\n";
    }
    text += "Filters:\n";
    for (const shadow::FilterRow& f : shadow::filter_table())
        text += "  " + padded(std::string(f.name), kKeyWidth) + std::to_string(f.taps) +
                (f.taps == 1 ? " tap" : " taps") + "\n";
    return text;
}

}  // namespace gnomon::game
