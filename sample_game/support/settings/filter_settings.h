#pragma once
#include <string>
#include <string_view>

#include "sample_game/support/settings/light_settings.h"

namespace gnomon::game {

/// Sets and reads the setting "filter": `automatic`, or the name of a row of the filter table.
bool set_filter(LightSettings& settings, std::string_view text);
std::string get_filter(const LightSettings& settings);
/// `automatic`, then the rows; empty beyond the last.
std::string_view filter_name(std::size_t index);

/// The filter table's names, as an error message lists them.
std::string filter_names();

/// The filter table for --list: taps, half-width, storage and sampler of each row.
std::string list_filters();

}  // namespace gnomon::game
