#pragma once
#include <cstdint>
#include <map>
#include <utility>

#include "engine/gl/device_recording.h"

namespace gnomon {

/// What depth maps would contain if a recorded list had been drawn: a number per layer. It follows from all that the
/// layer's texels follow from. These are the matrices, placements and triangles of what was drawn since it was cleared,
/// and the faces that were culled. It does not depend on the order of draws or the number of passes.
class MapContents {
public:
    /// Follows a list's clears, copies and draws. `device` must have run the list just now: its buffers contain what
    /// the draws read.
    void draw(const gl::CommandList& list, const gl::RecordingDevice& device);

    /// Returns the number of a target's layer. 0: never drawn to.
    std::uint64_t of(gl::TargetHandle target, const gl::RecordingDevice& device) const;

private:
    using Layer = std::pair<std::uint32_t, std::int32_t>;  // texture, layer
    std::map<Layer, std::uint64_t> layers_;
};

}  // namespace gnomon
