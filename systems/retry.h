#pragma once
#include <cstdint>

namespace gnomon {

/// Time at which a failed device operation may be repeated. Memory may become free again; a retry in every frame would
/// cost a compilation or an allocation each. 30 frames recover within half a second at 60 Hz.
class Retry {
public:
    static constexpr std::uint64_t kFrames = 30;
    bool due(std::uint64_t frame) const { return frame >= next_frame_; }
    void failed(std::uint64_t frame) { next_frame_ = frame + kFrames; }

private:
    std::uint64_t next_frame_ = 0;
};

}  // namespace gnomon
