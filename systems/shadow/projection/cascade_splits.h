#pragma once
#include <cstdint>
#include <span>

#include "components/shadow_tuning.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/cascade_ends.h"

/// Where a sun's cascades begin and end along the view.
namespace gnomon::shadow {

/// Whether split_lambda and blend are in their ranges, and manual distances finite, positive and rising.
bool are_splits(const ShadowTuning::Cascades& tuning);

/// How many cascades the light asks for, 1 to kMaxCascades; `automatic` where it leaves the choice.
std::uint32_t cascade_count(const LightItem& light, std::uint32_t automatic);

/// Cascade i of `count` reaches from ends[i] to ends[i + 1]; never falling, ends[0] = whole.lowest and
/// ends[count] = whole.highest. Logarithmic parts exist for perspective views only (Zhang et al. 2006, "practical split
/// scheme"). `receivers`: depths of what is seen, in any order, for CascadeSplits::seen, and sampled without counts
/// (systems/shadow/fitting/directional/sdsm_splits.h); it is sorted.
CascadeEnds cascade_ends(const ShadowTuning::Cascades& tuning, std::uint32_t count, const DepthSpan& whole,
                         bool perspective, std::span<DepthSpan> receivers);

}  // namespace gnomon::shadow
