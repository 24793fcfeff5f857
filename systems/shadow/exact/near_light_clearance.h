#pragma once
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/types.h"

namespace gnomon::shadow {

/// How far from a lamp with a size to look for casters, in radii of its source and in distances of its maps' near
/// planes: the larger.
inline constexpr double kClearance_radii = 32.0, kClearance_nears = 4.0;

/// ShadowDemand::clear_m of the lamps whose maps are for a source with a size (FilterStorage::soft_sheets): how near to
/// the lamp any caster's triangle comes that the map of an opening does not hold whole, behind its near plane, but that
/// comes within the source's radius of the opening's pyramid; of any opening, drawn or not. At most as far as is looked
/// for. In double, of triangles as they are bent.
void measure_clearances(const SceneSnapshot& scene, const GpuScene& gpu, ShadowFrame& frame);

}  // namespace gnomon::shadow
