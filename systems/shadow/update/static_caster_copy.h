#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/budget/automatic_limit.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/update/update_inputs.h"

namespace gnomon::shadow {

/// Bytes that take as long to copy as one triangle takes to draw (docs/explanation/caching.md, "Caching", has the
/// measurement).
inline constexpr std::uint64_t kCopiedBytesPerTriangle = 256;

/// Work of drawing a view's static casters from which the budget leaves room for their copy, as bytes that take as long
/// to copy. It is as much as all maps take by the automatic limit: a million triangles.
inline constexpr std::uint64_t kWorthRoom_bytes = kAutomatic_bytes;

/// Returns whether drawing these casters is more work than copying `bytes`. Counted, not timed, so that the result is
/// the same on every device.
bool pays_to_copy(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> static_casters,
                  std::uint64_t bytes);

/// Plans copies of static casters for views in which only some casters move, where copying is less work than drawing.
void copy_static_casters(const SceneSnapshot& scene, const GpuScene& gpu, const UpdateInputs& inputs, MapCache& maps,
                         std::vector<UpdatePlan>& plans);

}  // namespace gnomon::shadow
