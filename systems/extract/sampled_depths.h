#pragma once
#include <array>
#include <cstdint>

#include "engine/ecs/entity.h"

namespace gnomon {

/// Bin i holds view distances from 2^((i + kFirstDepthStep) / 4) m to the next bin's: 6e-8 m to 1e12 m. Being fixed to
/// the metre and not to a camera, bins stay where they are while cameras move, and a scene scaled by 2^k shifts its
/// counts by 4 k bins. Also in shaders/lighting/post/depth_histogram.comp.
inline constexpr std::uint32_t kDepthBins = 256;
inline constexpr int kFirstDepthStep = -96;

/// At which view distances the pixels of an earlier picture lie. A hint: it may be late, of another place, or missing.
struct SampledDepths {
    ecs::Entity camera = {};  // whose picture; none: nothing is known
    bool failed = false;      // asked for, but the device did not give it
    std::array<std::uint32_t, kDepthBins> pixels{};
    bool operator==(const SampledDepths&) const = default;
};

}  // namespace gnomon
