#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// Half-open range of indices into a flat array.
struct IndexRange {
    std::uint32_t first = 0, count = 0;
    std::uint32_t end() const { return first + count; }
    bool operator==(const IndexRange&) const = default;
};

/// Returns the elements of `items` in the range, which must lie within it.
template <class T>
std::span<const T> slice(const std::vector<T>& items, IndexRange range) {
    return std::span(items).subspan(range.first, range.count);
}
template <class T>
std::span<const T> slice(std::span<const T> items, IndexRange range) {
    return items.subspan(range.first, range.count);
}

/// Returns the bit of a camera in a mask. All cameras from the 32nd on share the last bit.
inline std::uint32_t consumer_bit(std::uint32_t consumer) { return 1u << std::min(consumer, 31u); }

}  // namespace gnomon::shadow
