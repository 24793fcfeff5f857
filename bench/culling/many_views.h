#pragma once
#include <benchmark/benchmark.h>

#include <array>

namespace gnomon::bench {

struct ViewsBenchmark {
    const char* name;
    void (*run)(benchmark::State&);  // range(0): boxes; range(1): threads
};

/// Returns benchmarks of four suns, 24 spots and four points: 64 views, less the faces of cubes that show nothing. They
/// time receivers, casters and fits while the camera moves. One has the plain as far as it goes, the other a sight of
/// 60 m.
std::array<ViewsBenchmark, 2> views_benchmarks();

/// Times a loop that reads each of range(0) boxes once, which bounds what any search without a tree takes.
void read_boxes(benchmark::State& state);

}  // namespace gnomon::bench
