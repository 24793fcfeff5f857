#pragma once

namespace gnomon::bench {

inline constexpr double kUsPerMs = 1000.0, kBytesPerMiB = 1024.0 * 1024.0;

}  // namespace gnomon::bench
