#pragma once
#include <span>
#include <string>
#include <string_view>

#include "gnomon/light.h"
#include "sample_game/support/settings/light_settings.h"

/// Purposes of the settings, as a panel groups them, and the lights for which each one has an effect.
namespace gnomon::game {

/// Setting in a group of a panel.
struct SettingUse {
    const char* key;
    /// Returns whether the setting changes anything for this light with these settings. Null: always.
    bool (*works)(const LightSettings& settings, LightKind kind) = nullptr;
    const char* needs = "";  // what has to be so for it to work; empty: nothing
};

/// Settings with one purpose; each key is in one of these groups.
struct PurposeGroup {
    const char* name;
    const char* meaning;  // one line: when to change these
    std::span<const SettingUse> settings;
};
/// Returns all groups, the most used first.
std::span<const PurposeGroup> purpose_groups();

/// Returns why a setting has no effect now: what it needs. Empty: it has one.
std::string_view why_idle(const SettingUse& use, const LightSettings& settings, LightKind kind);

/// Sets all keys of a group to their defaults.
void reset_group(const PurposeGroup& group, LightSettings& settings);
/// Returns whether a setting has its default.
bool is_default(const LightSetting& setting, const LightSettings& settings);

}  // namespace gnomon::game
