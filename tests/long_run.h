#pragma once
#include <cstdlib>

namespace gnomon {

/// Says whether this run plays every row and all rounds: GNOMON_LONG is set by `./gnomon test --long`, which CI runs.
inline bool is_long_run() { return std::getenv("GNOMON_LONG") != nullptr; }

}  // namespace gnomon
