#pragma once
#include <cstdint>
#include <string>

#include "bench/common/stage.h"

namespace gnomon::bench {

struct QueriesOptions {
    std::uint32_t places = 1000000, repeat = 9;
    unsigned threads = 2;
};

/// How fast visibility queries are answered in a scene, and what the trees behind them take to build, to refit and to
/// hold: a table. Without a GPU. Errors: those of the loader.
Result<std::string> measure_queries(const StageOptions& stage, const QueriesOptions& options);

}  // namespace gnomon::bench
