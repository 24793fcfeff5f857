#pragma once
#include "systems/shadow/fitting/directional/cascade_fit.h"
#include "systems/shadow/request/light_kinds.h"

/// Fits for filters that need true distances of casters, because they soften shadows by the size of the source.
namespace gnomon::shadow {

/// Fits one cascade by its ShadowFit. Returns false if nothing finite lies in it. For a filter that needs distances,
/// the depth range reaches up to the highest caster that matters, and the border contains the widest penumbra. Depth
/// clamping would flatten such a caster onto the near plane, too near to its shadow. A caster matters if its bounds lie
/// over the map, or if the source darkens the map from their height. Range and border grow in steps, so that a map may
/// stay.
bool fit_cascade(const CascadeInput& input, OrthographicBox& box);

/// Returns FitInput::reach_texel for a map with visible part `content` and penumbrae that reach `aside` beyond it, in
/// the same unit.
float penumbra_border_texel(const FitInput& input, double content, double aside);

}  // namespace gnomon::shadow
