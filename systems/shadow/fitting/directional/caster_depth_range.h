#pragma once
#include "systems/shadow/fitting/directional/cascade_fit.h"
#include "systems/shadow/request/light_kinds.h"

/// Fits for filters that need true distances of casters, because they soften shadows by the size of the source.
namespace gnomon::shadow {

/// Fits as ShadowFit has it. If the filter asks, depth reaches up to the highest caster that matters, which depth
/// clamping would else flatten onto the near plane, so that it seemed to stand nearer to its shadow than it does; and
/// the border holds the widest penumbra that follows. A caster matters if its bounds lie over the map, or so far aside
/// that the source darkens the map from its height. Range and border grow in steps, so that a map may stay.
bool fit_cascade(const CascadeInput& input, OrthographicBox& box);

/// FitInput::reach_texel for a map of which `content` is to be seen and penumbrae reach `aside` beyond, in the same
/// unit.
float penumbra_border_texel(const FitInput& input, double content, double aside);

}  // namespace gnomon::shadow
