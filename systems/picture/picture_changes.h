#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_frame.h"

namespace gnomon::picture {

/// Records what the last picture followed from, and detects a picture that shows the same. Maps may be drawn again
/// meanwhile: samples through any valid map belong into one mean.
class PictureChanges {
public:
    /// Returns whether all inputs equal those of the last call. Never while a map is stale, nor with a debug view.
    bool unchanged(const SceneSnapshot& scene, const shadow::ShadowFrame& shadows, const FrameSettings& settings);

private:
    /// Settings that pictures follow from, apart from their size, which cameras have.
    struct Settings {
        std::optional<float> exposure_ev;
        bool shadows = true, rays = true, leave_out_dim_lights = true, transparent = false;
        shadow::ShadowBudget budget;
        std::uint32_t noise_frame = 0;
        bool operator==(const Settings&) const = default;
    };
    /// What became of a light's shadow.
    struct Outcome {
        Reason skipped = Reason::none, degraded = Reason::none;
        bool operator==(const Outcome&) const = default;
    };

    std::uint64_t version_ = 0;
    std::vector<ConsumerItem> consumers_, pictures_;
    Settings settings_;
    std::vector<Outcome> outcomes_, now_;
};

}  // namespace gnomon::picture
