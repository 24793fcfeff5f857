#pragma once
#include <optional>

#include "systems/extract/sampled_depths.h"
#include "systems/shadow/frame/quality_limits.h"
#include "systems/spare_memory.h"

namespace gnomon::shadow {

/// What lighting hands back to the shadows of the next frame.
struct LightingFeedback {
    SampledDepths sampled_depths;  // measured by systems/lighting/depth_sampler.h; optional
    /// Factor of the picture's radiance before the tone curve, if known. Lights with invisible shadows are then culled
    /// (culling/contribution_culling.h). Empty: no light is.
    std::optional<double> exposure = {};
    /// Memory that lighting gives up before any map has to. Outlives the next frame; null: none.
    SpareMemory* spare = nullptr;
};

/// What a frame's shadows follow from, beside the scene.
struct ShadowSettings {
    bool shadows = true;  // false: every light counts as disabled
    ShadowBudget budget = {};
    LightingFeedback feedback = {};
    bool rays = true;  // false: no light uses rays, which need exact surfaces in every picture (Reason::rays_off)
};

}  // namespace gnomon::shadow
