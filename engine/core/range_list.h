#pragma once
#include <cstdint>
#include <vector>

namespace gnomon {

/// Ranges of numbered places, taken and given back. A range is taken at the lowest place where it fits. Time grows with
/// the number of free ranges, not of places.
class RangeList {
public:
    static constexpr std::uint32_t kNone = ~0u;

    /// Takes `count` neighbouring places. Returns the first one; kNone: there is no room. A count of 0 takes nothing.
    std::uint32_t take(std::uint32_t count);
    /// Gives places back that take() returned.
    void give(std::uint32_t first, std::uint32_t count);
    /// Sets the number of places; at least end().
    void resize(std::uint32_t places);

    std::uint32_t places() const { return places_; }
    std::uint32_t used() const { return used_; }
    /// Returns the place behind the last one in use.
    std::uint32_t end() const;

private:
    struct Range {
        std::uint32_t first = 0, count = 0;
        std::uint32_t end() const { return first + count; }
    };
    std::vector<Range> free_;  // sorted, no neighbours
    std::uint32_t places_ = 0, used_ = 0;
};

}  // namespace gnomon
