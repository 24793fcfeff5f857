#pragma once
#include <span>
#include <string>

#include "sample_game/support/settings/light_settings.h"

namespace gnomon::game {

/// The rows of light_settings() that say how a map is read.
std::span<const LightSetting> filter_settings();

/// The filter table's names, as an error message lists them.
std::string filter_names();

/// The filter table for --list: taps, half-width, storage and sampler of each row.
std::string list_filters();

}  // namespace gnomon::game
