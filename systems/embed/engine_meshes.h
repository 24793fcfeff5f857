#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/result.h"
#include "gnomon/shadows.h"
#include "systems/extract/mesh_records.h"

namespace gnomon::embed {

/// Meshes that lie in buffers of the engine's own. Owns the imports, not the buffers.
class EngineMeshes {
public:
    explicit EngineMeshes(gl::Device& device) : device_(device) {}
    ~EngineMeshes();
    EngineMeshes(const EngineMeshes&) = delete;
    EngineMeshes& operator=(const EngineMeshes&) = delete;

    /// Takes a mesh's buffers. Errors as Shadows::add_buffer_mesh(). On success keep() comes next.
    Result<EngineMesh> import(const BufferMeshDesc& desc);
    /// Keeps what import() took last, as the mesh of that number in the library.
    void keep(std::uint32_t mesh);
    /// Gives up a mesh. Returns false if it is none of these.
    bool remove(std::uint32_t mesh);

    /// Returns meshes with a buffer that the engine deleted, or made too small; sorted. Queries each buffer.
    std::span<const std::uint32_t> lost();

private:
    /// Buffer of the engine's, once for all meshes that lie in it.
    struct Buffer {
        unsigned name = 0;  // 0: unused
        std::uint64_t bytes = 0;
        gl::BufferHandle handle{};
        std::uint32_t users = 0;
    };
    /// Part of a buffer that a mesh reads.
    struct Use {
        std::uint32_t buffer = 0;  // index into buffers_
        std::uint64_t bytes = 0;   // from the buffer's start; 0: no mesh
    };
    struct Uses {
        Use vertices, indices;
    };
    Use use(unsigned name, std::uint64_t bytes);
    void give(const Use& use);

    gl::Device& device_;
    std::vector<Buffer> buffers_;
    std::vector<Uses> uses_;  // by mesh
    Uses imported_;
    std::vector<std::uint32_t> lost_;
    std::vector<unsigned> names_;  // one per Buffer
    std::vector<std::uint64_t> sizes_, sizes_before_;
    bool meshes_changed_ = false;
};

}  // namespace gnomon::embed
