#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/frame.h"
#include "systems/extract/snapshot.h"
#include "systems/frame_timers.h"

namespace gnomon::shadow {

/// GPU time of drawing one view of each light, as last measured. Devices may answer some frames late.
class DrawTimes {
public:
    /// Records the frame that was just submitted; its timers will name it.
    void submitted(std::uint64_t submission, const SceneSnapshot& scene, const FrameReport& report);
    /// Learns what was measured since the last call. Ignores submissions older than the last kFrames.
    void learn(std::span<const gl::Timing> timings);

    /// Returns the microseconds per view; empty: never measured.
    std::optional<double> view_us(ecs::Entity light) const;

    static constexpr std::size_t kFrames = kTimedSubmissions;

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
