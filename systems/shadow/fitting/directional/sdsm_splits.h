#pragma once
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/light_status.h"
#include "systems/shadow/frame/shadow_view.h"

/// CascadeSplits::sampled: splits by where the pixels of an earlier picture lie.
namespace gnomon::shadow {

/// Some sun that has views this frame wants to know where pixels lie.
bool wants_sampled_depths(const SceneSnapshot& scene, const FittedViews& fitted, std::span<const LightStatus> statuses);

struct SampledSplit {
    const SampledDepths& depths;
    const ConsumerItem& consumer;
    std::uint32_t count;  // of cascades, 1 to kMaxCascades
    DepthSpan whole;      // 0 < lowest <= highest < infinity
    double width_m;       // across the view, of what maps have to hold; may be infinite
};

/// The ends, among the edges of bins, that make texels smallest as the counted pixels see them. A slice's map is taken
/// to be as wide as the view at its far end, but no wider than what it has to hold, and as long as the slice; a pixel's
/// width grows with its distance (perspective); the least sum of their ratio over all pixels. The first and the last
/// end are those of `whole`, none falls. False: nothing is known of this consumer.
bool sampled_ends(const SampledSplit& split, CascadeEnds& ends_m);

/// The same, but the ends of `held` as long as the sum is at most a tenth above the least: counts flicker while the
/// camera moves.
bool held_sampled_ends(const SampledSplit& split, const HeldEnds& held, HeldEnds& next, CascadeEnds& ends_m);

}  // namespace gnomon::shadow
