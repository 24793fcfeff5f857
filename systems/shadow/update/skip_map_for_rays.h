#pragma once
#include <vector>

#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/update/update_inputs.h"

namespace gnomon::shadow {

/// What drawing a light's maps of sheets would draw.
struct SheetLoad {
    double triangles = 0.0, texels = 0.0;
};

/// Says whether rays for all pixels cost less than to draw that and use rays for the uncertain pixels.
bool are_rays_cheaper(double pixels, double rays_per_pixel, const SheetLoad& load);

/// Leaves lights to rays whose maps would be drawn anew, and probably in the next frame again, for more than rays for
/// all their pixels cost (UpdatePlan::left_to_rays).
void skip_maps_for_rays(const SceneSnapshot& scene, const GpuScene& gpu, const UpdateInputs& inputs, MapStore& maps,
                        std::vector<UpdatePlan>& plans);

}  // namespace gnomon::shadow
