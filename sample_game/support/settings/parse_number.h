#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Numbers as users type them, read strictly: the whole text, no spaces, no sign '+', neither NaN nor infinity.
namespace gnomon::game {

std::optional<double> read_number(std::string_view text);
std::optional<std::uint64_t> read_count(std::string_view text);  // decimal digits only

/// Makes `text` fit for one line of a terminal: control characters become '?'.
std::string on_one_line(std::string_view text);

}  // namespace gnomon::game
