#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_settings.h"

namespace gnomon::shadow {

/// Records what the stages read in the last frame, and detects a frame in which they would read the same. Costs one
/// comparison per camera, whatever the size of the scene: its version stands for the rest.
class FrameReuse {
public:
    /// Returns whether all inputs equal those of the last call. Never for a scene of version 0: it does not count
    /// changes.
    bool unchanged(const SceneSnapshot& scene, const ShadowSettings& settings);

private:
    std::uint64_t version_ = 0;
    bool shadows_ = false, rays_ = false;
    ShadowBudget budget_;
    std::vector<ConsumerItem> consumers_, pictures_;
    SampledDepths sampled_depths_;
    std::optional<double> exposure_;
};

}  // namespace gnomon::shadow
