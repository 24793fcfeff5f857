#include "sample_game/support/settings/light_settings.h"

#include <algorithm>
#include <array>

#include "gnomon/light.h"
#include "sample_game/support/settings/filter_settings.h"
#include "sample_game/support/settings/parse_number.h"
#include "sample_game/support/settings/setting_rows.h"

namespace gnomon::game {
namespace {

Error bad(std::string message, const char* rule) { return {.message = "--set: " + on_one_line(message), .rule = rule}; }

/// Pads a text to `width`, with at least one blank after it.
std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size() + 1), ' ');
    return text;
}

}  // namespace

std::optional<LightSettings> settings_of(const ecs::Registry& registry, ecs::Entity light) {
    const LightShadow* shadow = registry.get<LightShadow>(light);
    if (!shadow) return std::nullopt;
    LightSettings settings;
    settings.shadow = *shadow;
    if (const ShadowTuning* tuning = registry.get<ShadowTuning>(light)) settings.tuning = *tuning;
    if (const Light* own = registry.get<Light>(light)) {
        settings.source_radius_m = own->source_radius_m;
        settings.sun_radius_rad = own->sun_radius_rad;
        settings.width_m = own->width_m;
        settings.height_m = own->height_m;
    }
    return settings;
}

void put_settings(ecs::Registry& registry, ecs::Entity light, const LightSettings& settings) {
    const std::optional<LightSettings> now = settings_of(registry, light);
    if (!now || !(now->shadow == settings.shadow)) registry.emplace<LightShadow>(light, settings.shadow);
    const ShadowTuning* tuning = registry.get<ShadowTuning>(light);
    if (!(settings.tuning == (tuning ? *tuning : ShadowTuning{})))
        registry.emplace<ShadowTuning>(light, settings.tuning);
    const Light* own = registry.get<Light>(light);
    if (!own) return;
    Light sized = *own;
    sized.source_radius_m = settings.source_radius_m;
    sized.sun_radius_rad = settings.sun_radius_rad;
    sized.width_m = settings.width_m;
    sized.height_m = settings.height_m;
    const bool same = own->source_radius_m == sized.source_radius_m && own->sun_radius_rad == sized.sun_radius_rad &&
                      own->width_m == sized.width_m && own->height_m == sized.height_m;
    if (!same) registry.emplace<Light>(light, sized);
}

std::span<const SettingGroup> setting_groups() {
    static const std::array kGroups{
        SettingGroup{"shadow", "what a light's author sets (LightShadow)", shadow_rows()},
        SettingGroup{"size", "how large the light's source is (Light)", size_rows()},
        SettingGroup{"kernel", "taps and spread of filters (ShadowTuning::kernel)", kernel_rows()},
        SettingGroup{"moments", "prefiltered maps (ShadowTuning::moments)", moments_rows()},
        SettingGroup{"bias", "offset against self-shadowing (ShadowTuning::bias)", bias_rows()},
        SettingGroup{"projection", "views from the light (ShadowTuning::projection)", projection_rows()},
        SettingGroup{"cascades", "where a sun's maps lie (ShadowTuning::cascades)", cascades_rows()},
        SettingGroup{"maps", "how maps are stored and drawn (ShadowTuning::maps)", maps_rows()},
        SettingGroup{"reuse", "what is kept from frame to frame (ShadowTuning::reuse)", reuse_rows()}};
    return kGroups;
}

const LightSetting* find_setting(std::string_view key) {
    for (const SettingGroup& group : setting_groups())
        for (const LightSetting& setting : group.settings)
            if (key == setting.key) return &setting;
    return nullptr;
}

std::optional<Error> apply_setting(LightSettings& settings, std::string_view key_value) {
    const std::size_t equals = key_value.find('=');
    const std::string text(key_value);
    if (equals == std::string_view::npos) return bad("'" + text + "' is not KEY=VALUE", "set.syntax");
    const std::string key(key_value.substr(0, equals));
    const LightSetting* row = find_setting(key);
    if (!row) return bad("unknown key '" + key + "'; --list shows them", "set.key");
    if (!row->set(settings, key_value.substr(equals + 1))) {
        const std::string allowed = key == "filter" ? filter_names() : row->values;
        return bad("'" + text + "': " + key + " takes " + allowed, "set.value");
    }
    return std::nullopt;
}

std::string list_settings() {
    const LightSettings defaults;
    constexpr std::size_t kKeyWidth = 26, kValueWidth = 40;
    std::string text = "Keys of --set KEY=VALUE (for every light with a shadow):\n";
    for (const SettingGroup& group : setting_groups()) {
        text += std::string(" ") + group.name + ": " + group.meaning + "\n";
        for (const LightSetting& s : group.settings) {
            text += "  " + padded(s.key, kKeyWidth) + padded(s.values, kValueWidth) + s.meaning;
            text += " (default: " + s.get(defaults) + ")\n";
        }
    }
    text += list_filters();
    return text;
}

}  // namespace gnomon::game
