#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "gnomon/registry.h"
#include "gnomon/result.h"
#include "gnomon/shadow_tuning.h"

/// The settings of a light's shadow by name: one row per key, for --set, --list and anything else that edits them.
namespace gnomon::game {

/// All settings of one light, from its components.
struct LightSettings {
    float source_radius_m = 0.0f, sun_radius_rad = 0.0f;  // fields of Light
    float width_m = 1.0f, height_m = 1.0f;
    LightShadow shadow = {};
    ShadowTuning tuning = {};
    bool operator==(const LightSettings&) const = default;
};

/// Reads the entity's components. Returns nothing if it has no LightShadow.
std::optional<LightSettings> settings_of(const ecs::Registry& registry, ecs::Entity light);

/// Writes the components that differ. Adds a LightShadow if there is none, and a ShadowTuning if one is needed.
void put_settings(ecs::Registry& registry, ecs::Entity light, const LightSettings& settings);

/// Calls change(LightSettings&) for a light with a LightShadow, and writes the result to its components.
template <class Change>
void change_settings(ecs::Registry& registry, ecs::Entity light, Change&& change) {
    std::optional<LightSettings> settings = settings_of(registry, light);
    if (!settings) return;
    change(*settings);
    put_settings(registry, light, *settings);
}

/// Editor of a setting in a panel: on or off, one of LightSetting::choice's words, a number of 0 to slider_most, or
/// typed text.
enum class SettingEditor : std::uint8_t { toggle, choice, number, text };
inline constexpr SettingEditor kToggle = SettingEditor::toggle, kChoice = SettingEditor::choice,
                               kNumber = SettingEditor::number, kText = SettingEditor::text;

struct LightSetting {
    const char* key;
    const char* field;    // C++ name of what it sets: component, then member
    const char* values;   // what may be written, for people
    const char* meaning;  // one line
    /// Sets the value. Returns false, with nothing changed, if `text` is no value of this key.
    bool (*set)(LightSettings& settings, std::string_view text);
    std::string (*get)(const LightSettings& settings);  // a text that `set` reads back to the same value
    SettingEditor editor;
    std::string_view (*choice)(std::size_t index) = nullptr;  // choice alone: its words; empty beyond the last
    double slider_most = 0.0;                                 // number alone: end of the slider; `set` takes more
    bool whole = false;                                       // number alone: it has no fraction
};

/// Settings that tune one thing; no key is in two groups.
struct SettingGroup {
    const char* name;
    const char* meaning;  // one line: what they tune, and which component holds them
    std::span<const LightSetting> settings;
};
/// Returns all groups. The fields of LightShadow, which every author needs, come first.
std::span<const SettingGroup> setting_groups();

/// Finds a setting by its key. Null: there is none.
const LightSetting* find_setting(std::string_view key);

/// Applies "KEY=VALUE". Errors: rules "set.syntax", "set.key", "set.value"; `settings` are then unchanged.
std::optional<Error> apply_setting(LightSettings& settings, std::string_view key_value);

/// Returns the settings as --list prints them.
std::string list_settings();

}  // namespace gnomon::game
