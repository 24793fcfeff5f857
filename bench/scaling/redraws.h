#pragma once
#include <cstdint>
#include <string>

#include "bench/common/stage.h"
#include "engine/core/result.h"

namespace gnomon::bench {

/// How many maps the built-in scene's lights draw in each frame, and why, for every fit of a sun, while the camera
/// stands still, walks and pans, and with a box that goes to and fro between the lantern and the ground before the
/// camera. Counted on the recording device: nothing is drawn or timed. A table for people. Of `options`, scene, camera,
/// size and settings count. Errors: of the scene and the settings; "camera.unknown".
Result<std::string> redraws_table(const StageOptions& options, std::uint32_t frames);

}  // namespace gnomon::bench
