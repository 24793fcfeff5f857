#pragma once
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace gnomon::oracle {

/// Calls work(row) for every row in [0, rows), on `threads` threads (0: one per core). Rows are independent.
template <class Work>
void parallel_rows(std::uint32_t rows, unsigned threads, const Work& work) {
    if (threads == 0) threads = std::thread::hardware_concurrency();
    std::atomic<std::uint32_t> next{0};
    const auto drain = [&] {
        for (std::uint32_t row = next++; row < rows; row = next++) work(row);
    };
    std::vector<std::thread> helpers;
    for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(drain);
    drain();
    for (std::thread& helper : helpers) helper.join();
}

}  // namespace gnomon::oracle
