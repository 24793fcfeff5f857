#pragma once
#include <cstdint>
#include <limits>

namespace gnomon::shadow {

/// What shadows may take (docs/economy.md, "Budgets"). What is 0, below, or no number sets no bound.
struct ShadowBudget {
    std::uint64_t bytes = 0;  // all that lights hold: maps, triangles, moments, copies
    float gpu_ms = 0.0f;      // of a frame: drawing maps, and looking them up
    std::uint64_t rays =
        0;  // that pixels of exact lights may ask in a frame, as they are predicted (budget/ray_budget.h)
    bool operator==(const ShadowBudget&) const = default;
};

/// What a budget leaves of what a light asks for. The default leaves all.
struct Grant {
    static constexpr std::uint32_t kAny = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t most_px = kAny;      // edge of its maps
    std::uint32_t most_views = kAny;   // of a sun: cascades
    std::uint32_t refresh_frames = 1;  // a view whose casters alone changed is drawn in one frame of so many
    bool plain = false;                // looked up by the cheapest filter, kPlainFilter
    bool none = false;                 // no shadow at all
    bool operator==(const Grant&) const = default;
};

}  // namespace gnomon::shadow
