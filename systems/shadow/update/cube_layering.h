#pragma once
#include <cstdint>

#include "engine/gl/device.h"
#include "gnomon/shadow_tuning.h"

namespace gnomon::shadow {

/// Chooses how `faces` faces of one light are drawn in this frame. A single face is always a pass of its own, as are
/// faces that the device cannot layer. docs/contributors/experiments.md has the figures behind `automatic`.
inline CubeRoute cube_route(CubeRoute requested, const gl::DeviceInfo& device, std::uint32_t faces) {
    if (faces < 2 || requested == CubeRoute::automatic) return CubeRoute::six_passes;
    if (requested == CubeRoute::layered_vertex && !device.vertex_layer) return CubeRoute::six_passes;
    return requested;
}

}  // namespace gnomon::shadow
