#pragma once
#include <string>

namespace gnomon::bench {

/// Shares of 1 are printed times this.
inline constexpr double kPercent = 100.0;

/// Formats as printf does, to a string of any length.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

}  // namespace gnomon::bench
