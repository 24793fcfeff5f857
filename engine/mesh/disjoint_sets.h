#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace gnomon::assets {

/// Union-find with path halving and union by index: near-linear, no recursion.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }

    /// Returns the smallest member of each one's set.
    std::vector<std::uint32_t> firsts() {
        std::vector<std::uint32_t> first(parent_.size());
        for (std::uint32_t i = 0; i < first.size(); ++i) first[i] = find(i);
        return first;
    }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace gnomon::assets
