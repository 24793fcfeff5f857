#pragma once
#include <string>

namespace gnomon::bench {

/// Measures the CPU's time for finding receivers and casters and for fitting views to them, by Google Benchmark. The
/// scenes are 1000 to 100 000 random boxes on a plain. Prints its table. `filter`: regular expression for names of
/// benchmarks; empty: all. Uses no GPU.
void run_culling(const std::string& filter);

}  // namespace gnomon::bench
