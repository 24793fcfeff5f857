#pragma once
#include <cstdint>
#include <vector>

#include "engine/gl/handles.h"

namespace gnomon::shadow {

/// What the still casters of a light's map leave in it, layer by layer: where some casters move, it is copied over
/// instead of being drawn again. It is there only while a view has both kinds and the copy is less work.
struct StillMap {
    gl::TextureHandle texture{}, triangles{};  // {0} while there is none; the second beside triangles of the map
    struct Layer {
        std::uint64_t content = 0;  // ShadowSlot::still_content of what it holds; 0: nothing
        std::uint64_t drawn = 0;    // the same of what the map showed when it was last drawn
    };
    std::vector<Layer> layers;
    std::uint64_t last_used_frame = 0, retry_frame = 0;
};

}  // namespace gnomon::shadow
