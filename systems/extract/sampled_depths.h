#pragma once
#include <array>
#include <cstdint>

#include "gnomon/components.h"

namespace gnomon {

/// Number of depth bins. Bin i covers view distances from 2^((i + kFirstDepthStep) / 4) m to the next bin's start: 6e-8
/// m to 1e12 m. Bins are fixed in metres, independent of cameras, so that they stay put while cameras move. A scene
/// scaled by 2^k shifts its counts by 4 k bins. Also in shaders/lighting/post/depth_histogram.comp.
inline constexpr std::uint32_t kDepthBins = 256;
inline constexpr int kFirstDepthStep = -96;

/// Histogram of view distances in an earlier picture. A hint: it may be late, from another place, or missing.
struct SampledDepths {
    ecs::Entity camera = {};  // camera of the picture; none: no data
    bool failed = false;      // requested, but not delivered by the device
    std::array<std::uint32_t, kDepthBins> pixels{};
    bool operator==(const SampledDepths&) const = default;
};

}  // namespace gnomon
