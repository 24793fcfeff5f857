#pragma once
#include <cstddef>
#include <vector>

namespace gnomon {

/// How the pixels of a picture change while its camera jitters by less than a pixel.
struct JitteredPixels {
    std::size_t inner = 0;     // amid nine alike in every phase: no edge crosses them
    std::size_t shimmers = 0;  // inner pixels with another value in another phase
    std::size_t edges = 0;     // not amid nine alike, and changing
    std::size_t slivers = 0;   // amid nine alike at first, and changing: crossed by what is thinner than a pixel
};

/// Counts them in pictures of one channel, one per phase.
template <class T>
JitteredPixels jittered_pixels(const std::vector<std::vector<T>>& phases, std::size_t width) {
    JitteredPixels counts;
    const std::size_t height = phases.front().size() / width;
    for (std::size_t y = 1; y + 1 < height; ++y)
        for (std::size_t x = 1; x + 1 < width; ++x) {
            const auto is_even = [&](const std::vector<T>& seen) {
                const T& middle = seen[y * width + x];
                for (std::size_t v = y - 1; v <= y + 1; ++v)
                    for (std::size_t u = x - 1; u <= x + 1; ++u)
                        if (!(seen[v * width + u] == middle)) return false;
                return true;
            };
            bool always_even = true, same = true;
            for (const std::vector<T>& seen : phases) {
                always_even = always_even && is_even(seen);
                same = same && seen[y * width + x] == phases.front()[y * width + x];
            }
            const bool first_even = is_even(phases.front());
            counts.inner += always_even;
            counts.shimmers += always_even && !same;
            counts.edges += !first_even && !same;
            counts.slivers += first_even && !always_even && !same;
        }
    return counts;
}

}  // namespace gnomon
