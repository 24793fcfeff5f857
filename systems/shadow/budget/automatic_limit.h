#pragma once
#include <cstdint>
#include <span>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/light_status.h"
#include "systems/shadow/frame/shadow_view.h"

/// Limit on the bytes of maps where ShadowBudget::bytes leaves it to the system. It binds only in frames with
/// lights that want more; in others nothing of a budget runs.
namespace gnomon::shadow {

/// Bytes of maps up to a picture of kLimitPixels. Larger pictures need more texels, and get them in proportion.
inline constexpr std::uint64_t kAutomatic_bytes = 256'000'000;
inline constexpr std::uint64_t kLimitPixels = 1920 * 1080;

/// Returns the limit for these cameras, by the sum of their pixels.
std::uint64_t automatic_limit(std::span<const ConsumerItem> consumers);

/// Returns whether the automatic limit applies to the light: neither its size nor its accuracy is given. What is given
/// is a demand, and comes on top of the limit.
bool leaves_size(const LightItem& light);

/// Bytes of the maps that lights with views want, as fitted.
struct WantedBytes {
    std::uint64_t limited = 0;  // maps of lights within the automatic limit
    std::uint64_t given = 0;    // maps of the others
};
WantedBytes wanted_bytes(const SceneSnapshot& scene, const FittedViews& fitted, std::span<const LightStatus> statuses);

}  // namespace gnomon::shadow
