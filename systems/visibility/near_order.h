#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "systems/visibility/light_queries.h"

namespace gnomon::visibility {

/// Puts places in an order in which those next to each other are near each other: that of the cells of a grid along
/// Morton's curve. Keeps its storage.
class NearOrder {
public:
    /// Valid until the next call. At most 2^32 places.
    std::span<const std::uint32_t> of(std::span<const Place> places);

private:
    std::vector<std::uint32_t> order_, keys_, sorted_;
};

}  // namespace gnomon::visibility
