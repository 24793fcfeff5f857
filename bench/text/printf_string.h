#pragma once
#include <string>

namespace gnomon::bench {

/// As printf would write it, of any length.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

}  // namespace gnomon::bench
