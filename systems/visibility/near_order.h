#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "systems/visibility/light_queries.h"

namespace gnomon::visibility {

/// Orders places so that consecutive ones are close to each other: cells of a grid along Morton's curve. Reuses its
/// memory.
class NearOrder {
public:
    /// Returns the order of at most 2^32 places. Valid until the next call.
    std::span<const std::uint32_t> of(std::span<const Place> places);

private:
    std::vector<std::uint32_t> order_, keys_, sorted_;
};

}  // namespace gnomon::visibility
