#pragma once
#include <cstdint>
#include <limits>

namespace gnomon::shadow {

/// Limits on all shadows together (docs/economy.md, "Budgets"). 0, negative or NaN: no limit.
struct ShadowBudget {
    std::uint64_t bytes = 0;  // GPU memory of all lights: maps, triangles, moments, copies
    float gpu_ms = 0.0f;      // GPU time per frame for drawing maps and looking them up
    std::uint64_t rays = 0;   // predicted rays per frame of lights that use rays (request/ray_limit.h)
    bool operator==(const ShadowBudget&) const = default;
};

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
