#include "systems/embed/engine_meshes.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "engine/gl/device_gl45.h"
#include "engine/math/aabb.h"
#include "engine/math/finite.h"

namespace gnomon::embed {
namespace {

/// Largest stride that every OpenGL 4.5 has (GL_MAX_VERTEX_ATTRIB_STRIDE).
constexpr std::uint32_t kMostStride = 2048;

gl::PositionFormat format_of(PositionFormat format) {
    constexpr std::array kFormats{gl::PositionFormat::float32, gl::PositionFormat::float16, gl::PositionFormat::snorm16,
                                  gl::PositionFormat::unorm16};
    return kFormats[static_cast<std::size_t>(format)];
}

Error mesh_error(const BufferMeshDesc& desc, const char* what, const char* rule) {
    std::string name = desc.name.empty() ? "mesh" : "mesh " + std::string(desc.name);
    return {name + " " + what, {}, {}, rule};
}

}  // namespace

EngineMeshes::~EngineMeshes() {
    for (const Buffer& buffer : buffers_) device_.destroy(buffer.handle);
}

/// Imports a buffer, unless that was done before. Returns no bytes if it has fewer.
EngineMeshes::Use EngineMeshes::use(unsigned name, std::uint64_t bytes) {
    std::uint64_t has_bytes = 0;
    gl::buffer_sizes(device_, {&name, 1}, {&has_bytes, 1});
    if (bytes > has_bytes) return {};
    const auto same = [&](const Buffer& b) { return b.users > 0 && b.name == name && b.bytes == has_bytes; };
    auto at = std::find_if(buffers_.begin(), buffers_.end(), same);
    if (at == buffers_.end()) {
        const auto handle = gl::import_buffer(device_, name, {"engine's mesh", has_bytes, gl::BufferUse::fixed, false});
        if (!handle) return {};
        at = std::find_if(buffers_.begin(), buffers_.end(), [](const Buffer& b) { return b.users == 0; });
        if (at == buffers_.end()) at = buffers_.emplace(buffers_.end());
        *at = {name, has_bytes, handle, 0};
    }
    ++at->users;
    return {static_cast<std::uint32_t>(at - buffers_.begin()), bytes};
}

void EngineMeshes::give(const Use& use) {
    if (use.bytes == 0) return;
    Buffer& buffer = buffers_[use.buffer];
    if (--buffer.users > 0) return;
    device_.destroy(buffer.handle);
    buffer = {};
}

Result<EngineMesh> EngineMeshes::import(const BufferMeshDesc& desc) {
    const gl::MeshLayout layout{desc.stride_bytes, desc.position_offset_bytes, format_of(desc.format),
                                desc.index_size == IndexSize::u16};
    const math::Aabb box{desc.bounds.min_m, desc.bounds.max_m};
    if (desc.index_count == 0 || desc.index_count % 3 != 0)
        return mesh_error(desc, "has no triangles, or indices that are no multiple of three", "mesh.empty");
    const std::uint32_t vertex_bytes = gl::position_bytes(layout.position);
    if (desc.vertex_count == 0 || layout.stride < vertex_bytes || layout.stride > kMostStride)
        return mesh_error(desc, "has no vertices, or a stride below a position's size or above 2048 bytes",
                          "mesh.layout");
    if (!math::is_finite(box) || math::is_empty(box))
        return mesh_error(desc, "has bounds that are no box", "mesh.bounds");
    const std::uint64_t index_end = std::uint64_t{desc.first_index} + desc.index_count;
    Uses uses;
    if (layout.position_offset < ~std::uint64_t{0} >> 1)
        uses.vertices =
            use(desc.vertex_buffer,
                layout.position_offset + std::uint64_t{desc.vertex_count - 1} * layout.stride + vertex_bytes);
    uses.indices = use(desc.index_buffer, index_end * layout.index_bytes());
    if (uses.vertices.bytes == 0 || uses.indices.bytes == 0) {
        give(uses.vertices);
        give(uses.indices);
        return mesh_error(desc, "has a name that is no buffer, or a range beyond a buffer's end", "mesh.buffer");
    }
    imported_ = uses;
    return EngineMesh{buffers_[uses.vertices.buffer].handle,
                      buffers_[uses.indices.buffer].handle,
                      layout,
                      desc.first_index,
                      desc.index_count,
                      desc.base_vertex};
}

void EngineMeshes::keep(std::uint32_t mesh) {
    if (uses_.size() <= mesh) uses_.resize(mesh + std::size_t{1});
    uses_[mesh] = std::exchange(imported_, {});
    meshes_changed_ = true;
}

bool EngineMeshes::remove(std::uint32_t mesh) {
    if (mesh >= uses_.size() || uses_[mesh].vertices.bytes == 0) return false;
    give(uses_[mesh].vertices);
    give(uses_[mesh].indices);
    uses_[mesh] = {};
    meshes_changed_ = true;
    return true;
}

std::span<const std::uint32_t> EngineMeshes::lost() {
    names_.clear();
    for (const Buffer& buffer : buffers_) names_.push_back(buffer.name);
    std::swap(sizes_, sizes_before_);
    sizes_.resize(names_.size());
    gl::buffer_sizes(device_, names_, sizes_);
    if (!std::exchange(meshes_changed_, false) && sizes_ == sizes_before_) return lost_;
    lost_.clear();
    const auto lacks = [&](const Use& use) { return sizes_[use.buffer] < use.bytes; };
    for (std::uint32_t m = 0; m < uses_.size(); ++m)
        if (uses_[m].vertices.bytes > 0 && (lacks(uses_[m].vertices) || lacks(uses_[m].indices))) lost_.push_back(m);
    return lost_;
}

}  // namespace gnomon::embed
