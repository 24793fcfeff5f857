#pragma once
#include <string>

namespace gnomon::bench {

/// Formats as printf does, to a string of any length.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

}  // namespace gnomon::bench
