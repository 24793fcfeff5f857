#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/types.h"

namespace gnomon::shadow {

/// Stage 4: the views of every light that is not skipped, each with its own casters and predicted edge error.
/// Sets sets[i].skip = fit_degenerate where no finite volume exists. Pure but for `frame`; `held` is the next_history
/// of the frame before (empty: none), frame.next_history that of this one.
void fit_views(const SceneSnapshot& scene, const History& held, ShadowFrame& frame);

}  // namespace gnomon::shadow
