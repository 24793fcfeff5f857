#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

/// A set of indices as bits: what a search finds in any order comes out in rising order, and once.
namespace gnomon::shadow {

inline void clear_marks(std::vector<std::uint64_t>& marks, std::size_t count) { marks.assign((count + 63) / 64, 0); }

inline void mark(std::vector<std::uint64_t>& marks, std::uint32_t i) { marks[i / 64] |= std::uint64_t{1} << i % 64; }

template <class Visit>
void for_each_mark(const std::vector<std::uint64_t>& marks, Visit&& visit) {
    for (std::size_t word = 0; word < marks.size(); ++word)
        for (std::uint64_t bits = marks[word]; bits != 0; bits &= bits - 1)
            visit(static_cast<std::uint32_t>(word * 64) + static_cast<std::uint32_t>(std::countr_zero(bits)));
}

}  // namespace gnomon::shadow
