#pragma once
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/update/update_inputs.h"

namespace gnomon::shadow {

/// Work of drawing a light's conservative maps.
struct BoundsLoad {
    double triangles = 0.0, texels = 0.0;
};

/// Returns whether rays for all pixels cost less than drawing the maps and tracing rays for undecided pixels.
bool are_rays_cheaper(double pixels, double rays_per_pixel, const BoundsLoad& load);

/// Replaces maps by rays for lights with maps that change in every frame (UpdatePlan::skipped_for_rays). Applies where
/// rays for all their pixels cost less than drawing the maps.
void skip_maps_for_rays(const SceneSnapshot& scene, const GpuScene& gpu, const UpdateInputs& inputs, MapCache& maps,
                        std::vector<UpdatePlan>& plans);

}  // namespace gnomon::shadow
