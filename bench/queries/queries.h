#pragma once
#include <cstdint>
#include <string>

#include "bench/common/stage.h"

namespace gnomon::bench {

struct QueriesOptions {
    std::uint32_t places = 1000000, repeat = 9;
    unsigned threads = 2;
};

/// Returns a table of the speed of visibility queries in a scene, and of their trees' memory and times to build and
/// refit. Uses no GPU. Errors: those of the loader.
Result<std::string> measure_queries(const StageOptions& stage, const QueriesOptions& options);

}  // namespace gnomon::bench
