#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/assets.h"
#include "gnomon/result.h"
#include "systems/extract/scene_materials.h"
#include "systems/extract/scene_meshes.h"
#include "systems/extract/snapshot.h"

namespace gnomon {

/// Instance on the device; matches InstanceRecord in shaders/common/instances.glsl. 64 bytes. w components hold the
/// high part of the translation. `low_layers`: its low part, and the layers that may shadow the instance.
struct InstanceRecord {
    float basis_x_high_x[4], basis_y_high_y[4], basis_z_high_z[4];
    float low_layers[4];
};
static_assert(sizeof(InstanceRecord) == 64);

/// Meshes, materials, textures and instance records on the device. Owns its objects.
class GpuScene {
public:
    using MeshRange = gnomon::MeshRange;
    using SubmeshRange = gnomon::SubmeshRange;
    using MaterialInfo = gnomon::MaterialInfo;
    using MeshShape = SceneMeshes::Shape;

    /// Uploads the library. `library` must outlive the scene, because some buffers are built only when a light needs
    /// them. Error (rule "gpu.scene") if the device has no room; nothing is left behind then.
    static Result<GpuScene> create(gl::Device& device, const assets::MeshLibrary& library);
    GpuScene(GpuScene&& other) noexcept { *this = std::move(other); }
    GpuScene& operator=(GpuScene&&) noexcept;
    ~GpuScene() { release(); }

    /// Follows meshes, materials and textures that came to the library or went (MeshLibrary::add() and others). Records
    /// their uploads. Call it once per frame before the snapshot is filled, if the library may
    /// have changed. The cost is that of the meshes that came, and a comparison per slot.
    void update_meshes(gl::CommandList& list);
    /// Returns meshes that the device has no room for, sorted. No snapshot may list instances of them. update_meshes()
    /// tries them again, as soon as places are free or after Retry::kFrames.
    std::span<const std::uint32_t> lacking_meshes() const { return meshes_.lacking(); }

    /// Records the upload of changed instance records, and of meshes with a changed pose. Each mesh is deformed once
    /// per change. Grows the instance buffer when needed. Returns false if it could not grow: instances from capacity()
    /// on must not be drawn.
    bool update(const SceneSnapshot& snapshot, gl::CommandList& list);
    std::uint32_t capacity() const { return instance_capacity_; }
    /// Notes the result of a submission; call it after each. `executed` false: the next updates repeat the uploads.
    void submitted(bool executed);

    /// Creates caster_triangles() and caster_masks() if missing. Call it in each frame with a light that reads them.
    /// Returns false without room on the device; retries after Retry::kFrames such frames.
    bool provide_caster_triangles() { return meshes_.provide_caster_triangles(); }

    /// Does what SceneMeshes does of the same name. The buffers stay their owner's.
    void put_engine_mesh(std::uint32_t mesh, const EngineMesh& of);
    const EngineMesh* engine_mesh(std::uint32_t mesh) const { return meshes_.engine_mesh(mesh); }
    const MeshRange& mesh(std::uint32_t index) const { return meshes_.mesh(index); }
    /// Returns what depth passes need of the mesh. Made once, when the mesh or some material came.
    const MeshDepthFacts& depth_facts(std::uint32_t mesh) const { return depth_facts_[mesh]; }
    const SubmeshRange& submesh(std::uint32_t index) const { return meshes_.submesh(index); }
    const MaterialInfo& material(std::uint32_t index) const { return materials_.material(index); }
    bool any_masked() const { return materials_.any_masked(); }         // any material is masked
    bool any_unlit() const { return materials_.any_unlit(); }           // any material is unlit
    bool any_transmits() const { return materials_.any_transmits(); }   // any material is of a translucent caster
    float most_emissive() const { return materials_.most_emissive(); }  // maximum over lit materials and channels
    const assets::MeshLibrary& library() const { return meshes_.library(); }
    std::size_t mesh_count() const { return meshes_.count(); }
    /// Returns the mesh's own lists, in the pose of the device after the recorded uploads.
    MeshShape shape(std::uint32_t mesh) const { return meshes_.shape(mesh); }

    gl::BufferHandle vertices() const { return meshes_.vertices(); }
    gl::BufferHandle indices() const { return meshes_.indices(); }
    /// Returns a buffer of vec4 per vertex, white for meshes without colours; {0}: no mesh has colours. Read as texels
    /// at bindings::kColourUnit by programs compiled with COLOURED.
    gl::BufferHandle colours() const { return meshes_.colours(); }
    /// Returns an InstanceRecord per slot, read as texels at bindings::kInstanceUnit.
    gl::BufferHandle instances() const { return instances_; }
    /// Returns a vec4 per triangle of `indices`, in model space, read as texels at bindings::kTriangleNormalUnit.
    gl::BufferHandle triangle_normals() const { return meshes_.triangle_normals(); }
    /// Returns a CasterTriangle per triangle of `indices`, read as texels; {0} until provided.
    gl::BufferHandle caster_triangles() const { return meshes_.caster_triangles(); }
    /// Returns the masks of masked triangles for shaders/ray_tracing/alpha_mask.glsl; {0}: none is masked, or not
    /// provided.
    gl::BufferHandle caster_masks() const { return meshes_.caster_masks(); }
    gl::BufferHandle material_uniforms() const { return materials_.uniforms(); }

    /// Returns the numbers of vertices and triangles that meshes have taken.
    std::uint32_t used_vertices() const { return meshes_.vertex_arrays().used(); }
    std::uint32_t used_triangles() const { return meshes_.triangle_arrays().used(); }
    /// Returns the number of triangles for which there are places: all numbers of triangles are below it.
    std::uint32_t triangle_places() const { return meshes_.triangle_arrays().places(); }

private:
    GpuScene() = default;
    void release();
    void update_instances(const SceneSnapshot& snapshot, gl::CommandList& list);
    void update_depth_facts();
    MeshDepthFacts make_depth_facts(std::uint32_t mesh) const;

    gl::Device* device_ = nullptr;
    SceneMeshes meshes_;
    SceneMaterials materials_;
    gl::BufferHandle instances_{};
    std::uint32_t instance_capacity_ = 0;
    bool upload_all_ = false;
    std::vector<InstanceRecord> records_;
    std::vector<MeshDepthFacts> depth_facts_;  // by mesh
    std::uint64_t seen_materials_ = 0;         // SceneMaterials::version() that they follow
};

}  // namespace gnomon
