#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/types.h"

namespace gnomon::shadow {

/// Stage 4: the views of every light that is not skipped, each with its own casters and predicted edge error.
/// Sets sets[i].skip = fit_degenerate where no finite volume exists. Pure but for `frame`; `held` is the next_history
/// of the frame before (empty: none), frame.next_history that of this one.
void fit_views(const SceneSnapshot& scene, const History& held, ShadowFrame& frame);

/// Of one light, for its demand: appends its views with their casters, or says in sets[d].skip why there are none.
/// `recount`: looks for another number of a sun's cascades now, where that is the fit's to choose.
void fit_light_views(const SceneSnapshot& scene, std::uint32_t d, const HeldLight& held, bool recount, HeldLight& next,
                     ShadowFrame& frame);

/// What is held of a light without what it is held for: as if the next fit were its first.
HeldLight without_fits(const HeldLight& held);

}  // namespace gnomon::shadow
