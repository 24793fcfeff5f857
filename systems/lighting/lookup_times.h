#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/components.h"
#include "systems/frame_timers.h"

namespace gnomon::lighting {

/// Lighting times of each light on the GPU, as last measured: looked up, and read from cached visibility. Devices may
/// report some frames late.
class LookupTimes {
public:
    /// Adds a recorded pass; `index`: of the light's timer.
    void add(std::uint32_t index, ecs::Entity light, bool kept) {
        recorded_.push_back({index, light, kept, 0, 0, 0.0});
    }
    /// Assigns all passes since the last call to a submission.
    void submitted(std::uint64_t submission);
    void learn(std::span<const gl::Timing> timings);

    /// Returns the microseconds saved by reading, >= 0; empty: one of both was not measured.
    std::optional<double> saved_us(ecs::Entity light) const;

    static constexpr std::size_t kFrames = kTimedSubmissions;

private:
    struct Pass {
        std::uint32_t index = 0;
        ecs::Entity light;
        bool kept = false;
        std::uint64_t frame = 0, submission = 0;
        double us = 0.0;
    };
    struct Measured {
        ecs::Entity light;
        std::optional<double> looked_up_us, kept_us;
    };
    std::vector<Pass> recorded_, passes_;  // current frame; last kFrames
    std::uint64_t frame_ = 0;
    std::vector<Measured> measured_;  // by the entity's index
};

}  // namespace gnomon::lighting
