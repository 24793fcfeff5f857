#pragma once
#include <span>
#include <string>
#include <string_view>

#include "sample_game/support/settings/light_settings.h"

/// Shadow settings in three words, for whoever does not want to choose each.
namespace gnomon::game {

struct Preset {
    const char* name;
    const char* meaning;                    // one line
    std::span<const char* const> settings;  // KEY=VALUE; empty: the defaults
};
/// From the fastest to the most accurate.
std::span<const Preset> presets();

/// Null: there is none of that name.
const Preset* find_preset(std::string_view name);

/// Sets what the preset says. Keys that another preset sets and this one does not go back to their defaults; all others
/// stay.
void apply_preset(const Preset& preset, LightSettings& settings);

/// The preset that would change nothing; null: none, something was set otherwise.
const Preset* preset_of(const LightSettings& settings);

/// What --list prints.
std::string list_presets();

}  // namespace gnomon::game
