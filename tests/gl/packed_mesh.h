#pragma once
#include <epoxy/gl.h>

#include <cstring>
#include <glm/gtc/packing.hpp>
#include <vector>

#include "gnomon/shadows.h"
#include "sample_game/support/built_in_scenes/primitives.h"

namespace gnomon {

/// How a test packs a mesh into its buffers.
struct Packing {
    const char* name;
    PositionFormat format = PositionFormat::float32;
    std::uint32_t stride_bytes = 12, position_offset_bytes = 0;
    IndexSize index_size = IndexSize::u32;
    std::uint32_t first_index = 0;
    std::int32_t base_vertex = 0;  // vertices before the mesh's own
};

inline std::size_t component_bytes(PositionFormat format) { return format == PositionFormat::float32 ? 4 : 2; }

inline void put_component(PositionFormat format, float value, std::byte* at) {
    std::uint16_t packed = 0;
    switch (format) {
        case PositionFormat::float32:
            std::memcpy(at, &value, sizeof value);
            return;
        case PositionFormat::float16:
            packed = glm::packHalf1x16(value);
            break;
        case PositionFormat::snorm16:
            packed = glm::packSnorm1x16(value);
            break;
        case PositionFormat::unorm16:
            packed = glm::packUnorm1x16(value);
            break;
    }
    std::memcpy(at, &packed, sizeof packed);
}

/// An engine's mesh in a vertex and an index buffer, with something else before and between.
class PackedMesh {
public:
    PackedMesh(const game::Shape& shape, const Packing& packing) {
        glCreateBuffers(1, &desc.vertex_buffer);
        glCreateBuffers(1, &desc.index_buffer);
        desc.name = "packed";
        desc.stride_bytes = packing.stride_bytes;
        desc.position_offset_bytes = packing.position_offset_bytes;
        desc.format = packing.format;
        desc.index_size = packing.index_size;
        desc.first_index = packing.first_index;
        desc.base_vertex = packing.base_vertex;
        desc.index_count = static_cast<std::uint32_t>(shape.indices.size());
        fill(shape);
    }
    PackedMesh(const PackedMesh&) = delete;
    PackedMesh& operator=(const PackedMesh&) = delete;
    ~PackedMesh() { drop(); }

    /// Writes the positions and indices into the buffers, which take their size.
    void fill(const game::Shape& shape) {
        const auto vertices = static_cast<std::size_t>(desc.base_vertex) + shape.positions.size();
        desc.vertex_count = static_cast<std::uint32_t>(vertices);
        std::vector<std::byte> bytes(desc.position_offset_bytes + vertices * desc.stride_bytes, std::byte{0xff});  // NaN
        desc.bounds = {glm::dvec3(1.0e9), glm::dvec3(-1.0e9)};
        for (std::size_t i = 0; i < shape.positions.size(); ++i) {
            const std::size_t at =
                desc.position_offset_bytes + (static_cast<std::size_t>(desc.base_vertex) + i) * desc.stride_bytes;
            for (glm::length_t axis = 0; axis < 3; ++axis)
                put_component(desc.format, shape.positions[i][axis],
                              &bytes[at + static_cast<std::size_t>(axis) * component_bytes(desc.format)]);
            desc.bounds.min_m = glm::min(desc.bounds.min_m, glm::dvec3(shape.positions[i]));
            desc.bounds.max_m = glm::max(desc.bounds.max_m, glm::dvec3(shape.positions[i]));
        }
        glNamedBufferData(desc.vertex_buffer, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STATIC_DRAW);
        std::vector<std::uint32_t> indices(desc.first_index, 0xffffffffu);
        indices.insert(indices.end(), shape.indices.begin(), shape.indices.end());
        const std::vector<std::uint16_t> small(indices.begin(), indices.end());
        const bool is_small = desc.index_size == IndexSize::u16;
        glNamedBufferData(desc.index_buffer, static_cast<GLsizeiptr>(indices.size() * (is_small ? 2 : 4)),
                          is_small ? static_cast<const void*>(small.data()) : indices.data(), GL_STATIC_DRAW);
    }
    void drop() const {
        glDeleteBuffers(1, &desc.vertex_buffer);
        glDeleteBuffers(1, &desc.index_buffer);
    }

    BufferMeshDesc desc;
};

}  // namespace gnomon
