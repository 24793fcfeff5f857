#pragma once
#include <cstdint>
#include <limits>

#include "gnomon/frame.h"

namespace gnomon::shadow {

/// Quality limits that a budget sets on one light. The default sets none.
struct QualityLimits {
    static constexpr std::uint32_t kAny = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t most_px = kAny;      // largest edge of its maps, texels
    std::uint32_t most_views = kAny;   // sun: largest number of cascades
    std::uint32_t refresh_frames = 1;  // period of drawing a view in which only casters changed, frames
    bool plain = false;                // it is looked up with the cheapest filter, kCheapestFilter
    bool none = false;                 // it has no shadow
    bool operator==(const QualityLimits&) const = default;
};

}  // namespace gnomon::shadow
