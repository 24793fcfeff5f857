#pragma once
#include <cstdlib>

namespace gnomon {

/// Returns whether this run plays every row and all rounds. `./gnomon test --long`, which CI runs, sets GNOMON_LONG.
inline bool is_long_run() { return std::getenv("GNOMON_LONG") != nullptr; }

/// True in a build with sanitizers: it runs ten times as slowly, and a few rounds of the same code show it what many
/// do.
#ifdef GNOMON_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace gnomon
