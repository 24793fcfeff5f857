#pragma once
#include <string>

namespace gnomon::bench {

/// What finding receivers and casters, and fitting views to them, costs the CPU: random boxes on a plain, 1000 to 100
/// 000, by Google Benchmark. Prints its table. `filter`: a regular expression for names of benchmarks; empty: all. No
/// GPU is used.
void run_culling(const std::string& filter);

}  // namespace gnomon::bench
