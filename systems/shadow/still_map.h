#pragma once
#include <cstdint>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/types.h"

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

/// Copied bytes that cost as much as drawing a triangle (docs/architecture.md, "Caching", has the measurement).
inline constexpr std::uint64_t kCopiedBytesPerTriangle = 256;

/// Whether drawing these casters is more work than copying so many bytes. Counted, not timed, so that it is the same on
/// every device.
bool pays_to_copy(const SceneSnapshot& scene, const GpuScene& gpu, std::span<const std::uint32_t> still_casters,
                  std::uint64_t bytes);

}  // namespace gnomon::shadow
