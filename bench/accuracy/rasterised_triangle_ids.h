#pragma once
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/result.h"
#include "systems/frame_system.h"
#include "tests/oracle/reference_tracer.h"

namespace gnomon::bench {

/// Returns the triangle that the last picture of `frame` shows at each pixel, rows bottom to top. It repeats the
/// surface pass, command by command, with a shader that writes numbers. `library` and `device` must be the frame's.
/// Errors: "bench.surfaces" if there is no picture, the device cannot, or a pixel's depth is not that of the picture.
Result<std::vector<oracle::PlacedTriangle>> drawn_triangles(gl::Device& device, const FrameSystem& frame,
                                                            const assets::MeshLibrary& library);

}  // namespace gnomon::bench
