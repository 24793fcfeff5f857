#pragma once
#include <benchmark/benchmark.h>

#include <array>

namespace gnomon::bench {

struct ListBenchmark {
    const char* name;
    void (*run)(benchmark::State&);  // range(0): instances
};

/// Returns benchmarks of the list of a scene's instances, through gnomon::Shadows and through the registry. Each is
/// made at once, and kept while one comes and one goes in each frame.
std::array<ListBenchmark, 4> list_benchmarks();

}  // namespace gnomon::bench
