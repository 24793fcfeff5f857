#pragma once
#include <cstdint>
#include <string>

#include "bench/common/stage.h"
#include "gnomon/result.h"

namespace gnomon::bench {

/// Returns a table of how many maps the scene's lights draw in each frame, and why, for every fit of a sun. The camera
/// stands still, walks and pans, without and with a mover between a lamp and the ground before the camera. The
/// recording device counts: nothing is drawn or timed. `options`: scene, camera, size and settings count. Errors: those
/// of scene and settings; "camera.unknown".
Result<std::string> redraws_table(const StageOptions& options, std::uint32_t frames);

}  // namespace gnomon::bench
