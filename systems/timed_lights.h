#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "systems/report.h"

namespace gnomon {

/// Whose the timers of the last submissions are. They name lights by their index in the frame that was submitted, and
/// devices may answer some frames late, when another light may have that index.
class TimedLights {
public:
    /// The frame that was just submitted, by the lights of its report.
    void submitted(std::uint64_t submission, const FrameReport& report);

    /// Adds the times of the newest frame that `timings` are of to the report: its sums, and to each light that is in
    /// the report its own. What lights took that are gone counts among the sums alone. Timings of submissions that are
    /// none of the last kFrames, or no frame's at all, mean nothing.
    void tell(std::span<const gl::Timing> timings, FrameReport& report) const;

    static constexpr std::size_t kFrames = 8;  // more than drivers queue

private:
    struct Submission {
        bool known = false;
        std::uint64_t number = 0;
        std::vector<ecs::Entity> lights;
    };
    const Submission* find(std::uint64_t number) const;

    std::array<Submission, kFrames> submissions_;
    std::size_t next_ = 0;
};

}  // namespace gnomon
