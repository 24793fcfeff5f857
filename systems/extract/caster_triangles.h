#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/mesh/mesh_topology.h"
#include "gnomon/assets.h"
#include "systems/extract/ray_masks.h"

namespace gnomon {

/// Mark of a masked triangle, stored as its first neighbour. Its other two neighbours are words of the masks: the
/// RayMask, and the texture coordinates.
inline constexpr std::uint32_t kMaskedTriangle = 0xFFFFFFFEU;

/// Record of a triangle, as shaders/shadow/filters/triangles/triangle_buffer.glsl reads it. A texel per corner:
/// position in model space, and the neighbour across the edge that starts there.
struct CasterTriangle {
    struct Corner {
        glm::vec3 position_ms{0.0f};
        std::uint32_t across = assets::kNoNeighbour;  // triangle in the common index buffer; see kMaskedTriangle
    };
    Corner corners[3];
    bool masked() const { return corners[0].across == kMaskedTriangle; }
};
static_assert(sizeof(CasterTriangle) == 48);

struct CasterTriangleList {
    std::vector<CasterTriangle> triangles;  // in the order of the common index buffer
    std::vector<std::uint32_t> masks;       // RayMasks::words(); empty: no triangle is masked
};

/// Appends the triangles of a mesh at rest. `first`: number of its first triangle in the common index buffer. Adds
/// what is missing to `masks`.
void append_caster_triangles(const assets::MeshLibrary& library, std::uint32_t mesh, std::uint32_t first,
                             RayMasks& masks, std::vector<CasterTriangle>& triangles);

/// Collects all triangles of a library at rest. Neighbours belong to the same mesh; both are opaque.
CasterTriangleList caster_triangles_of(const assets::MeshLibrary& library);

}  // namespace gnomon
