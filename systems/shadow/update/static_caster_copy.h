#pragma once
#include <cstdint>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/frame/types.h"

namespace gnomon::shadow {

/// Copied bytes that cost as much as drawing a triangle (docs/architecture.md, "Caching", has the measurement).
inline constexpr std::uint64_t kCopiedBytesPerTriangle = 256;

/// Whether drawing these casters is more work than copying so many bytes. Counted, not timed, so that it is the same on
/// every device.
bool pays_to_copy(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> still_casters,
                  std::uint64_t bytes);

}  // namespace gnomon::shadow
