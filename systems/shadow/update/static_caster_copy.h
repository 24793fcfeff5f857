#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/update/update_inputs.h"

namespace gnomon::shadow {

/// Copied bytes that cost as much as drawing a triangle (docs/economy.md, "Caching", has the measurement).
inline constexpr std::uint64_t kCopiedBytesPerTriangle = 256;

/// Whether drawing these casters is more work than copying so many bytes. Counted, not timed, so that it is the same on
/// every device.
bool pays_to_copy(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> still_casters,
                  std::uint64_t bytes);

/// Has views whose casters move in part copy the static ones, where that is less work than drawing them again.
void copy_static_casters(const SceneSnapshot& scene, const GpuScene& gpu, const UpdateInputs& inputs, MapStore& maps,
                         std::vector<UpdatePlan>& plans);

}  // namespace gnomon::shadow
