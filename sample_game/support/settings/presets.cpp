#include "sample_game/support/settings/presets.h"

#include <algorithm>
#include <array>

namespace gnomon::game {
namespace {

constexpr std::array kFast{"filter=hardware_2x2", "resolution=1024", "cascades=2"};
constexpr std::array kHigh{"filter=exact"};
const std::array kPresets{Preset{"fast", "one tap of small maps, two of them for a sun", kFast},
                          Preset{"default", "sizes that keep max_error_px, exact edges", {}},
                          Preset{"high", "rays wherever a map is not certain", kHigh}};

std::string_view key_of(std::string_view setting) { return setting.substr(0, setting.find('=')); }

/// Sets a key back to its default.
void reset(std::string_view key, LightSettings& settings) {
    const LightSetting& setting = *find_setting(key);
    setting.set(settings, setting.get(LightSettings{}));
}

}  // namespace

std::span<const Preset> presets() { return kPresets; }

const Preset* find_preset(std::string_view name) {
    const auto found =
        std::find_if(kPresets.begin(), kPresets.end(), [&](const Preset& preset) { return name == preset.name; });
    return found == kPresets.end() ? nullptr : &*found;
}

void apply_preset(const Preset& preset, LightSettings& settings) {
    for (const Preset& other : kPresets)
        for (const char* setting : other.settings) reset(key_of(setting), settings);
    for (const char* setting : preset.settings) (void)apply_setting(settings, setting);
}

const Preset* preset_of(const LightSettings& settings) {
    for (const Preset& preset : kPresets) {
        LightSettings changed = settings;
        apply_preset(preset, changed);
        if (changed == settings) return &preset;
    }
    return nullptr;
}

std::string list_presets() {
    constexpr std::size_t kNameWidth = 9;
    std::string text = "Presets of --preset NAME, each of them settings as --set has them:\n";
    for (const Preset& preset : kPresets) {
        std::string name = preset.name;
        name.resize(std::max(kNameWidth, name.size()), ' ');
        text += "  " + name + preset.meaning + ":";
        for (const char* setting : preset.settings) text += std::string(" ") + setting;
        text += preset.settings.empty() ? " the defaults\n" : "\n";
    }
    return text;
}

}  // namespace gnomon::game
