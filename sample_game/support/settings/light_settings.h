#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "components/light_shadow.h"
#include "engine/core/result.h"

/// The fields of LightShadow by name: one row per key, for --set, --list and anything else that edits them.
namespace gnomon::game {

/// How a panel edits a setting: on or off, one of LightSetting::choice's words, a number of 0 to slider_most, or what
/// is typed.
enum class SettingEditor : std::uint8_t { toggle, choice, number, text };

struct LightSetting {
    const char* key;
    const char* values;   // what may be written, for people
    const char* meaning;  // one line
    /// False, and nothing changed, if `text` is no value of this key.
    bool (*set)(LightShadow& shadow, std::string_view text);
    std::string (*get)(const LightShadow& shadow);  // a text that `set` reads back to the same value
    SettingEditor editor;
    std::string_view (*choice)(std::size_t index) = nullptr;  // of a choice: its words; empty beyond the last
    double slider_most = 0.0;                                 // of a number: where a slider ends; `set` takes more
    bool whole = false;                                       // of a number: only whole ones
};
std::span<const LightSetting> light_settings();

/// Applies "KEY=VALUE". Errors: rules "set.syntax", "set.key", "set.value"; `shadow` is then unchanged.
std::optional<Error> apply_setting(LightShadow& shadow, std::string_view key_value);

/// What --list prints.
std::string list_settings();

}  // namespace gnomon::game
