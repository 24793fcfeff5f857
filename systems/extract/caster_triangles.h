#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/assets/mesh_library.h"
#include "engine/assets/mesh_topology.h"

namespace gnomon {

/// In place of the first neighbour of a masked triangle, which has none; the others are then words of the masks: its
/// RayMask, and its texture coordinates.
inline constexpr std::uint32_t kMaskedTriangle = 0xFFFFFFFEU;

/// What shaders/shadow/filters/triangles/triangle_buffer.glsl reads, a texel for each corner: it in model space, and
/// what lies beyond the edge that starts there.
struct CasterTriangle {
    struct Corner {
        glm::vec3 position_ms{0.0f};
        std::uint32_t across = assets::kNoNeighbour;  // a triangle of the common index buffer; see kMaskedTriangle
    };
    Corner corners[3];
    bool masked() const { return corners[0].across == kMaskedTriangle; }
};
static_assert(sizeof(CasterTriangle) == 48);

struct CasterTriangleList {
    std::vector<CasterTriangle> triangles;  // in the order of the common index buffer
    std::vector<std::uint32_t> masks;       // RayMasks::words(); empty: none of them is masked
};

/// All triangles of a library at rest. Neighbours are of the same mesh and opaque both.
CasterTriangleList caster_triangles_of(const assets::MeshLibrary& library);

}  // namespace gnomon
