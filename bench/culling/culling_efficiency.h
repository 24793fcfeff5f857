#pragma once
#include <optional>
#include <string>

#include "bench/common/stage.h"

namespace gnomon::bench {

/// How much of a scene each light's sets hold, and how much of that in vain: a table. Without a GPU.
/// Errors: those of the loader; "set.*"; "camera.unknown".
Result<std::string> set_shares(const StageOptions& options);

}  // namespace gnomon::bench
