#pragma once
#include <string>
#include <string_view>

#include "sample_game/support/settings/light_settings.h"

namespace gnomon::game {

/// Sets and reads the setting "filter": `automatic`, or the name of a row of the filter table.
bool set_filter(LightSettings& settings, std::string_view text);
std::string get_filter(const LightSettings& settings);
/// Returns the words of the setting: `automatic`, then the rows; empty beyond the last.
std::string_view filter_name(std::size_t index);

/// Lists the filter table's names for an error message.
std::string filter_names();

/// Prints the filter table for --list: taps, half-width, storage and sampler of each row.
std::string list_filters();

}  // namespace gnomon::game
