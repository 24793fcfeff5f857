#pragma once
#include <cstdint>

#include "bench/check/check_programs.h"
#include "bench/common/stage.h"

namespace gnomon::bench {

/// First frames of new systems on one device, which draw the same world: each must show the same. A device that does not
/// order a draw behind the uploads before it loses shadows there, and in no later frame.
struct FirstFrames {
    std::uint32_t drawn = 0, differ = 0;  // frames, and how many differ from the first in any visibility
    std::uint32_t most_px = 0;            // pixels by which one frame differs, summed over lights
    std::uint32_t dark_px = 0;            // pixels in shadow, in the first frame: 0 would prove nothing
    double took_s = 0.0;
    bool well() const { return differ == 0 && dark_px > 0; }
};

/// Draws `count` first frames of the stage's world. Throws FailedFrame as Stage::run_frame() does.
FirstFrames check_first_frames(Stage& stage, std::uint32_t count, const CheckProgress& progress);

}  // namespace gnomon::bench
