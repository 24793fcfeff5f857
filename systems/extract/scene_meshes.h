#pragma once
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/range_list.h"
#include "engine/gl/device.h"
#include "gnomon/assets.h"
#include "systems/device_arrays.h"
#include "systems/extract/caster_triangles.h"
#include "systems/extract/mask_buffer.h"
#include "systems/extract/mesh_records.h"
#include "systems/extract/ray_masks.h"
#include "systems/extract/scene_materials.h"
#include "systems/extract/snapshot.h"
#include "systems/retry.h"

namespace gnomon {

/// Shapes of a library's meshes in common buffers: vertices, triangles, and what filters read of them. Meshes keep
/// their places while they live. Owns the buffers.
class SceneMeshes {
public:
    SceneMeshes() = default;
    SceneMeshes(SceneMeshes&&) noexcept = default;
    SceneMeshes& operator=(SceneMeshes&&) noexcept = default;

    /// Uploads all meshes, in buffers of exactly their size. `library` must outlive the object.
    gl::Failure create(gl::Device& device, const assets::MeshLibrary& library);

    /// Follows changes of the library: records uploads of new meshes, frees the places of removed ones. A new mesh
    /// lacks room until the device has its `materials`.
    void follow(const SceneMaterials& materials, gl::CommandList& list);
    /// Records uploads of meshes with a changed pose.
    void update_poses(const SceneSnapshot& snapshot, gl::CommandList& list);
    /// Notes that the recorded uploads were executed, or that they are to be repeated.
    void submitted(bool executed);
    /// Creates the caster triangles and masks, as GpuScene::provide_caster_triangles().
    bool provide_caster_triangles();

    /// Returns meshes without room on the device, sorted.
    std::span<const std::uint32_t> lacking() const { return waiting_; }

    /// Mesh's own lists, in the pose of the device after the recorded uploads.
    struct Shape {
        const std::vector<assets::Vertex>* vertices = nullptr;
        const std::vector<std::uint32_t>* indices = nullptr;
        std::uint64_t version = 0;       // pose version; 0: at rest
        std::uint64_t mesh_version = 0;  // MeshLibrary::version_of()
    };
    Shape shape(std::uint32_t mesh) const;

    const MeshRange& mesh(std::uint32_t index) const { return ranges_[index]; }
    const SubmeshRange& submesh(std::uint32_t index) const { return submeshes_[index]; }
    std::size_t count() const { return ranges_.size(); }
    const assets::MeshLibrary& library() const { return *library_; }

    gl::BufferHandle vertices() const { return vertex_arrays_.buffer(kVertices); }
    gl::BufferHandle colours() const { return vertex_arrays_.buffer(kColours); }
    gl::BufferHandle indices() const { return triangle_arrays_.buffer(kIndices); }
    gl::BufferHandle triangle_normals() const { return triangle_arrays_.buffer(kNormals); }
    gl::BufferHandle caster_triangles() const { return triangle_arrays_.buffer(kCasters); }
    gl::BufferHandle caster_masks() const { return mask_buffer_.handle(); }
    /// Sets a mesh that lies in someone else's buffers; the library's has no triangles. No indices: it has none now.
    void put_engine_mesh(std::uint32_t mesh, const EngineMesh& of);
    /// Returns such a mesh; null: it is none.
    const EngineMesh* engine_mesh(std::uint32_t mesh) const {
        const bool is = mesh < engine_meshes_.size() && engine_meshes_[mesh].index_count > 0;
        return is ? &engine_meshes_[mesh] : nullptr;
    }
    /// Returns meshes that got or lost their places since forget_changed(); one may be named several times.
    std::span<const std::uint32_t> changed() const { return changed_; }
    void forget_changed() { changed_.clear(); }
    const DeviceArrays& vertex_arrays() const { return vertex_arrays_; }
    const DeviceArrays& triangle_arrays() const { return triangle_arrays_; }

private:
    enum VertexArray : std::size_t { kVertices, kColours };
    enum TriangleArray : std::size_t { kIndices, kNormals, kCasters };
    static constexpr std::uint64_t kUnknown = ~std::uint64_t{0};

    /// Places that a mesh has taken.
    struct Uploaded {
        std::uint64_t version = 0;  // MeshLibrary::version_of()
        std::uint32_t first_vertex = 0, vertices = 0, first_triangle = 0, triangles = 0;
        bool placed = false;
    };
    /// Deformable mesh in its pose on the device.
    struct Bent {
        std::uint32_t mesh = 0;
        std::uint64_t version = 0;  // pose version; 0: at rest; kUnknown: contents of the device are unknown
        std::vector<assets::Vertex> vertices;
        std::vector<CasterTriangle> triangles;  // empty without caster triangles on the device
    };

    /// Returns true if the mesh has its places, and is still the one in the library.
    bool is_current(std::uint32_t mesh) const {
        return uploaded_[mesh].placed && uploaded_[mesh].version == library_->version_of(mesh);
    }
    void add_range(std::uint32_t mesh, std::uint32_t first_vertex, std::uint32_t first_triangle);
    std::vector<Bent>::iterator bent_at(std::uint32_t mesh);
    Bent* bent_of(std::uint32_t mesh);
    std::span<const CasterTriangle> caster_records(std::uint32_t mesh, RayMasks& masks);
    void note_changes();
    void take_away(std::uint32_t mesh);
    void place_waiting(const SceneMaterials& materials, gl::CommandList& list);
    bool place(std::uint32_t mesh, bool may_grow, gl::CommandList& list);
    bool has_materials(std::uint32_t mesh, const SceneMaterials& materials) const;
    bool provide_colours(const assets::Mesh& mesh, bool may_grow);
    void write(std::uint32_t mesh, gl::CommandList& list);
    void upload(Bent& bent, gl::CommandList& list);
    static void put_corners(const std::vector<std::uint32_t>& indices, Bent& bent);
    void drop_casters();

    gl::Device* device_ = nullptr;
    const assets::MeshLibrary* library_ = nullptr;
    DeviceArrays vertex_arrays_, triangle_arrays_;
    MaskBuffer mask_buffer_;
    std::optional<RayMasks> masks_;          // while caster triangles are on the device, and meshes come and go
    std::vector<Uploaded> uploaded_;         // by mesh
    std::vector<MeshRange> ranges_;          // by mesh
    std::vector<EngineMesh> engine_meshes_;  // by mesh; shorter than the meshes: the others are none
    std::vector<SubmeshRange> submeshes_;
    RangeList submesh_places_;
    std::vector<Bent> bent_;  // all deformable meshes, sorted by mesh
    std::vector<std::uint32_t> waiting_, unwritten_, unconfirmed_, changed_;
    std::vector<glm::vec4> texel_scratch_;
    std::vector<CasterTriangle> caster_scratch_;
    Retry room_retry_, casters_retry_;
    std::uint64_t calls_ = 0, caster_calls_ = 0, seen_ = 0;
    bool is_streaming_ = false;  // the library has changed
};

}  // namespace gnomon
