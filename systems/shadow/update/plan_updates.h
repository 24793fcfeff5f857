#pragma once
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/update/update_inputs.h"
#include "systems/shadow/update/update_scheduler.h"

namespace gnomon::shadow {

/// Plans for each view with a map whether it is drawn, partly copied, kept, or replaced by rays; one entry per view.
/// Records in the map cache what lights need. `due` is overwritten.
void plan_updates(const SceneSnapshot& scene, const GpuScene& gpu, const UpdateInputs& inputs, MapCache& maps,
                  std::vector<DueView>& due, std::vector<UpdatePlan>& plans);

/// Keeps every map, in a frame in which nothing changed.
void keep_all(std::span<const MapAssignment> maps, std::vector<UpdatePlan>& plans);

}  // namespace gnomon::shadow
