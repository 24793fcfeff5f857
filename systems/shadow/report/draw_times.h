#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/snapshot.h"
#include "systems/report.h"

namespace gnomon::shadow {

/// What drawing one view of each light took on the GPU, when it was last measured. Devices may answer some frames late.
class DrawTimes {
public:
    /// The frame that was just submitted: whose timers its measurements will name.
    void submitted(std::uint64_t submission, const SceneSnapshot& scene, const FrameReport& report);
    /// What was measured since the last call; of other submissions than the last kFrames it means nothing.
    void learn(std::span<const gl::Timing> timings);

    /// Microseconds per view; empty: never measured.
    std::optional<double> view_us(ecs::Entity light) const;

    static constexpr std::size_t kFrames = 8;  // more than drivers queue

private:
    /// A light that drew anything in a frame.
    struct Drawn {
        std::uint64_t frame = 0, submission = 0;
        std::uint32_t light = 0, views = 0;
        ecs::Entity entity;
        double us = 0.0;
    };
    struct Measured {
        ecs::Entity entity;
        double view_us = 0.0;
    };
    std::vector<Drawn> drawn_;  // by rising frame, then by rising light
    std::uint64_t frame_ = 0;
    std::vector<Measured> measured_;  // by the entity's index
};

}  // namespace gnomon::shadow
