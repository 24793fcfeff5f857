#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/frame.h"
#include "systems/frame_timers.h"

namespace gnomon {

/// Owners of the timers of recent submissions. Timers name lights by their index in the submitted frame. Devices may
/// report some frames late, when another light has that index.
class TimedLights {
public:
    /// Registers the submitted frame with its report's lights.
    void submitted(std::uint64_t submission, const FrameReport& report);

    /// Adds the newest frame's times among `timings` to the report: to its sums, and to each light still in the report.
    /// Removed lights count only in the sums. Timings of other submissions than the last kFrames, or of no frame, are
    /// ignored.
    void tell(std::span<const gl::Timing> timings, FrameReport& report) const;

    static constexpr std::size_t kFrames = kTimedSubmissions;

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
