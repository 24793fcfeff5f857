#pragma once
#include <cstdint>
#include <span>

#include "gnomon/shadow_tuning.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/cascade_ends.h"

/// Split distances of a sun's cascades along the view.
namespace gnomon::shadow {

/// Returns true if split_lambda and blend are in their ranges, and manual distances finite, positive and rising.
bool are_splits(const ShadowTuning::Cascades& tuning);

/// Returns the number of cascades that the light requests, 1 to kMaxCascades; `automatic` where it gives none.
std::uint32_t cascade_count(const LightItem& light, std::uint32_t automatic);

/// Computes the split distances, metres: cascade i of `count` reaches from ends[i] to ends[i + 1]. They never fall,
/// ends[0] = whole.lowest and ends[count] = whole.highest. Only perspective views have a logarithmic part ("practical
/// split scheme", Zhang et al. 2006).
/// `receivers`: depths of visible receivers, in any order; sorted by this function. Read by CascadeSplits::seen, and by
/// sampled without counts (systems/shadow/fitting/directional/sdsm_splits.h).
CascadeSplitDistances cascade_split_distances(const ShadowTuning::Cascades& tuning, std::uint32_t count,
                                              const DepthSpan& whole, bool perspective, std::span<DepthSpan> receivers);

}  // namespace gnomon::shadow
