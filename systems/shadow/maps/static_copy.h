#pragma once
#include <cstdint>
#include <vector>

#include "engine/gl/handles.h"

namespace gnomon::shadow {

/// Copy of what the static casters of a light's map leave in it, layer by layer. Where only some casters move, it is
/// copied back instead of drawing the static ones again. It exists only while a view has both kinds and a copy is less
/// work.
struct StaticCopy {
    gl::TextureHandle texture{}, triangles{};  // {0}: there is none; the second beside triangles of the map
    struct Layer {
        std::uint64_t content = 0;  // ContentSignature::still of the copy; 0: nothing
        std::uint64_t drawn = 0;    // the same of what the map showed when it was last drawn
    };
    std::vector<Layer> layers;
    std::uint64_t last_used_frame = 0, retry_frame = 0;
    bool is_worth_room = false;  // it once saved kWorthRoom_bytes of work, and may again
};

}  // namespace gnomon::shadow
