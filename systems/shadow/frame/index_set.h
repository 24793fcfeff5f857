#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::shadow {

/// Set of indices. Indices added in any order, even repeatedly, are visited once and in rising order. Clearing and
/// visiting take time for the members, plus a 4096th of the range.
class IndexSet {
public:
    /// Empties the set and prepares it for indices below `count`.
    void clear(std::size_t count) {
        for_each_bit(used_, [&](std::size_t word) { words_[word] = 0; });
        const std::size_t words = (count + kBits - 1) / kBits;
        words_.resize(words, 0);
        used_.assign((words + kBits - 1) / kBits, 0);
    }

    void add(std::uint32_t i) {
        const std::size_t word = i / kBits;
        words_[word] |= std::uint64_t{1} << i % kBits;
        used_[word / kBits] |= std::uint64_t{1} << word % kBits;
    }

    /// Returns whether an index below the `count` of clear() is in the set.
    bool contains(std::uint32_t i) const { return (words_[i / kBits] >> i % kBits & 1) != 0; }

    template <class Visit>
    void for_each(Visit&& visit) const {
        for_each_bit(used_, [&](std::size_t word) {
            for (std::uint64_t bits = words_[word]; bits != 0; bits &= bits - 1)
                visit(static_cast<std::uint32_t>(word * kBits) + static_cast<std::uint32_t>(std::countr_zero(bits)));
        });
    }

private:
    static constexpr std::size_t kBits = 64;

    template <class Visit>
    static void for_each_bit(const std::vector<std::uint64_t>& words, Visit&& visit) {
        for (std::size_t word = 0; word < words.size(); ++word)
            for (std::uint64_t bits = words[word]; bits != 0; bits &= bits - 1)
                visit(word * kBits + static_cast<std::size_t>(std::countr_zero(bits)));
    }

    std::vector<std::uint64_t> words_;  // a bit per index
    std::vector<std::uint64_t> used_;   // a bit per word that is not 0
};

}  // namespace gnomon::shadow
