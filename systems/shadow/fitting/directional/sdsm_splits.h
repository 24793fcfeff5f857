#pragma once
#include "systems/extract/sampled_depths.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/light_status.h"
#include "systems/shadow/frame/shadow_view.h"

/// CascadeSplits::sampled: splits by the depths of the pixels of an earlier frame.
namespace gnomon::shadow {

/// Returns whether some sun with views in this frame uses sampled splits, so that the depths of pixels must be counted.
bool wants_sampled_depths(const SceneSnapshot& scene, const FittedViews& fitted, std::span<const LightStatus> statuses);

struct SampledSplit {
    const SampledDepths& depths;
    const ConsumerItem& consumer;
    std::uint32_t count;  // number of cascades, 1 to kMaxCascades
    DepthSpan whole;      // 0 < lowest <= highest < infinity
    double width_m;       // width across the view of what maps have to contain; may be infinite
};

/// Chooses the split distances, among the edges of bins, that make texels smallest as the counted pixels see them. The
/// error cost is the sum over all pixels of map size over pixel width. A slice's map is taken to be as wide as the view
/// at its far end, at most `width_m`, and as long as the slice. A pixel's width grows with its distance (perspective).
/// The first and the last distance equal `whole`; the distances never fall. Returns false if this camera has no counts.
bool sampled_splits(const SampledSplit& split, CascadeSplitDistances& ends_m);

/// Does the same with hysteresis: keeps `previous` while its cost is at most a tenth above the least. Counts flicker
/// while the camera moves.
bool held_sampled_splits(const SampledSplit& split, const SampledSplitHistory& previous, SampledSplitHistory& next,
                         CascadeSplitDistances& ends_m);

}  // namespace gnomon::shadow
