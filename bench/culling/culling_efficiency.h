#pragma once
#include <optional>
#include <string>

#include "bench/common/stage.h"

namespace gnomon::bench {

/// Returns a table of the share of a scene in each light's sets, and of the useless part of them. Uses no GPU.
/// Errors: those of the loader; "set.*"; "camera.unknown".
Result<std::string> set_shares(const StageOptions& options);

}  // namespace gnomon::bench
