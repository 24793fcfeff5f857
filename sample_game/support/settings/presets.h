#pragma once
#include <span>
#include <string>
#include <string_view>

#include "sample_game/support/settings/light_settings.h"

/// Shadow settings in three words, for users who do not choose each.
namespace gnomon::game {

struct Preset {
    const char* name;
    const char* meaning;                    // one line
    std::span<const char* const> settings;  // KEY=VALUE; empty: the defaults
};
/// Returns all presets, from the fastest to the most accurate.
std::span<const Preset> presets();

/// Finds a preset by its name. Null: there is none.
const Preset* find_preset(std::string_view name);

/// Applies the preset's settings. Keys that only other presets set go back to their defaults; all others stay.
void apply_preset(const Preset& preset, LightSettings& settings);

/// Returns the preset that would change nothing. Null: the settings match no preset.
const Preset* preset_of(const LightSettings& settings);

/// Returns the presets as --list prints them.
std::string list_presets();

}  // namespace gnomon::game
