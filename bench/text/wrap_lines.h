#pragma once
#include <cstddef>
#include <string>

namespace gnomon::bench {

/// Columns of a terminal that all tables and sentences fit into.
inline constexpr std::size_t kTerminalColumns = 120;

/// Breaks lines that are longer than `columns` at blanks. Lines without a blank there stay long. UTF-8 counts by
/// characters.
std::string wrapped(const std::string& text, std::size_t columns = kTerminalColumns);

}  // namespace gnomon::bench
