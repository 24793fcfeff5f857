#pragma once
#include <cstdint>
#include <map>
#include <utility>

#include "engine/gl/device_recording.h"

namespace gnomon {

/// What depth maps would hold if a recorded list had been drawn: a number per layer that follows from all that its
/// texels follow from, the matrices, the placement and the triangles of what was drawn since it was cleared, and the
/// faces that were culled. In whatever order, and in however many passes, things were drawn.
class MapContents {
public:
    /// `device` must have been given the list just now: its buffers hold what the list's draws read.
    void draw(const gl::CommandList& list, const gl::RecordingDevice& device);

    /// Of a layer's target; 0: never drawn to.
    std::uint64_t of(gl::TargetHandle target, const gl::RecordingDevice& device) const;

private:
    using Layer = std::pair<std::uint32_t, std::int32_t>;  // texture, layer
    std::map<Layer, std::uint64_t> layers_;
};

}  // namespace gnomon
