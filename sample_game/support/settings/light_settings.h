#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "components/shadow_tuning.h"
#include "engine/core/result.h"
#include "engine/ecs/registry.h"

/// The settings of a light's shadow by name: one row per key, for --set, --list and anything else that edits them.
namespace gnomon::game {

/// What is set of one light, in the components that hold it.
struct LightSettings {
    float source_radius_m = 0.0f, sun_radius_rad = 0.0f;  // of Light
    LightShadow shadow = {};
    ShadowTuning tuning = {};
    bool operator==(const LightSettings&) const = default;
};

/// Reads what the entity's components say. Nothing where it has no LightShadow.
std::optional<LightSettings> settings_of(const ecs::Registry& registry, ecs::Entity light);

/// Writes the components that differ. Adds a LightShadow where there is none, a ShadowTuning where one is needed.
void put_settings(ecs::Registry& registry, ecs::Entity light, const LightSettings& settings);

/// Calls change(LightSettings&) for a light that has a LightShadow, and writes what came of it.
template <class Change>
void change_settings(ecs::Registry& registry, ecs::Entity light, Change&& change) {
    std::optional<LightSettings> settings = settings_of(registry, light);
    if (!settings) return;
    change(*settings);
    put_settings(registry, light, *settings);
}

/// How a panel edits a setting: on or off, one of LightSetting::choice's words, a number of 0 to slider_most, or what
/// is typed.
enum class SettingEditor : std::uint8_t { toggle, choice, number, text };
inline constexpr SettingEditor kToggle = SettingEditor::toggle, kChoice = SettingEditor::choice,
                               kNumber = SettingEditor::number, kText = SettingEditor::text;

struct LightSetting {
    const char* key;
    const char* values;   // what may be written, for people
    const char* meaning;  // one line
    /// False, and nothing changed, if `text` is no value of this key.
    bool (*set)(LightSettings& settings, std::string_view text);
    std::string (*get)(const LightSettings& settings);  // a text that `set` reads back to the same value
    SettingEditor editor;
    std::string_view (*choice)(std::size_t index) = nullptr;  // of a choice: its words; empty beyond the last
    double slider_most = 0.0;                                 // of a number: where a slider ends; `set` takes more
    bool whole = false;                                       // of a number: only whole ones
};

/// Settings that tune one thing; no key is in two groups.
struct SettingGroup {
    const char* name;
    const char* meaning;  // one line: what they tune, and which component holds them
    std::span<const LightSetting> settings;
};
/// What an author needs comes first: the fields of LightShadow.
std::span<const SettingGroup> setting_groups();

/// Null: there is no such key.
const LightSetting* find_setting(std::string_view key);

/// Applies "KEY=VALUE". Errors: rules "set.syntax", "set.key", "set.value"; `settings` are then unchanged.
std::optional<Error> apply_setting(LightSettings& settings, std::string_view key_value);

/// What --list prints.
std::string list_settings();

}  // namespace gnomon::game
