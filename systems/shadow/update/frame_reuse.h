#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/quality_limits.h"

namespace gnomon::shadow {

/// Remembers what the stages read of the last frame, to tell whether they would read the same again. Costs a comparison
/// per camera, however large the scene: its version stands for the rest.
class StillFrame {
public:
    /// Whether all that is given is as it was in the last call. Never of a scene whose version is 0: nobody counts it.
    bool unchanged(const SceneSnapshot& scene, bool shadows, const ShadowBudget& budget);

private:
    std::uint64_t version_ = 0;
    bool shadows_ = false;
    ShadowBudget budget_;
    std::vector<ConsumerItem> consumers_, pictures_;
    SampledDepths sampled_depths_;
    std::optional<double> exposure_;
};

}  // namespace gnomon::shadow
