#pragma once
#include <span>
#include <vector>

#include "gnomon/core.h"
#include "systems/core/scene_input.h"
#include "systems/shadow/frame/light_status.h"
#include "systems/shadow/frame/shadow_view.h"

namespace gnomon::core {

/// What the stages of a frame left, as results are made of it.
struct StageResults {
    const SceneInput& input;
    const shadow::ReceiverCasterSets& sets;
    const shadow::FittedViews& fitted;
    std::span<const shadow::LightStatus> statuses;
};

/// Writes what each light got, and its views, in the caller's convention. Indices of casters refer to
/// FittedViews::casters, those of a light's sets to its own arrays.
void write_results(const StageResults& stages, const Convention& convention, std::vector<LightFit>& lights,
                   std::vector<View>& views);

}  // namespace gnomon::core
