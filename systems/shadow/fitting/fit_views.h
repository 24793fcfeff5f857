#pragma once
#include <span>

#include "systems/shadow/fitting/fit_light.h"
#include "systems/shadow/frame/light_accounts.h"

namespace gnomon::shadow {

/// Fits the views of every light that is not skipped, each with its own casters and predicted edge error (stage 4).
/// Skips a light with fit_degenerate where no finite volume exists. `next`: fit history for the next frame. Call after
/// select_sets() with the same storage; the result is the same on any number of threads.
void fit_views(const SceneSnapshot& scene, const FitInputs& inputs, StageStorage& storage, FittedViews& fitted,
               History& next, const LightAccounts& accounts);

}  // namespace gnomon::shadow
