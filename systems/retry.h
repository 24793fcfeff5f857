#pragma once
#include <cstdint>

namespace gnomon {

/// When something that failed on the device may be tried again: memory comes back, and so does what needs it,
/// within half a second at 60 Hz; trying every frame would cost a compilation or an allocation in each.
class Retry {
public:
    static constexpr std::uint64_t kFrames = 30;
    bool due(std::uint64_t frame) const { return frame >= next_frame_; }
    void failed(std::uint64_t frame) { next_frame_ = frame + kFrames; }

private:
    std::uint64_t next_frame_ = 0;
};

}  // namespace gnomon
