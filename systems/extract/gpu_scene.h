#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/assets/mesh_library.h"
#include "engine/core/result.h"
#include "engine/gl/device.h"
#include "systems/extract/caster_triangles.h"
#include "systems/extract/snapshot.h"
#include "systems/retry.h"

namespace gnomon {

/// Instance on the device; matches InstanceRecord in shaders/common/instances.glsl. 64 bytes. w components hold the
/// high part of the translation. `low_layers`: its low part, and the layers that may shadow the instance.
struct InstanceRecord {
    float basis_x_high_x[4], basis_y_high_y[4], basis_z_high_z[4];
    float low_layers[4];
};
static_assert(sizeof(InstanceRecord) == 64);

/// Material on the device; matches MaterialBlock in shaders/common/material.glsl (std140).
struct MaterialRecord {
    float base_colour[4];
    float emissive[4];                        // rgb; 1: unlit
    float metallic, roughness, alpha_cutoff;  // alpha_cutoff < 0: not masked
    float has_texture;
};
static_assert(sizeof(MaterialRecord) == 48);

/// Appends the geometric normal of each triangle of `indices`; zero without area. Computed in double: the cross product
/// of float edges is exact enough for a normal right to float rounding. w holds the residual of that rounding, to 2^-35
/// along each axis. It packs three signed integers of 10 bits, x lowest, in units of 2^-25 / 511 (plane_normal() in
/// shaders/lighting/gbuffer/surface_position_f64.glsl).
void append_plane_normals(std::span<const assets::Vertex> vertices, std::span<const std::uint32_t> indices,
                          std::vector<glm::vec4>& normals);

/// Bounds shaders/lighting/lights/brdf.glsl times its cosine over all directions, per unit of light. Lambert's term,
/// and GGX with D <= 1 / (pi alpha^2), V n.l <= 1 / (2 alpha), F <= 1.
float most_reflected(const assets::Material& material);

/// Meshes, materials, textures and instance records on the device. Owns its objects.
class GpuScene {
public:
    /// Uploads the library. `library` must outlive the scene, because some buffers are built only when a light needs
    /// them. Error (rule "gpu.scene") if the device has no room; nothing is left behind then.
    static Result<GpuScene> create(gl::Device& device, const assets::MeshLibrary& library);
    GpuScene(GpuScene&&) noexcept;
    GpuScene& operator=(GpuScene&&) noexcept;
    ~GpuScene();

    /// Records the upload of changed instance records, and of meshes with a changed pose. Each mesh is deformed once
    /// per change. Grows the instance buffer when needed. Returns false if it could not grow: instances from capacity()
    /// on must not be drawn.
    bool update(const SceneSnapshot& snapshot, gl::CommandList& list);
    std::uint32_t capacity() const { return instance_capacity_; }
    /// Makes the next update() repeat the last upload. Call it after a failed submission.
    void forget_uploads();

    /// Creates caster_triangles() and caster_masks() if missing. Call it in each frame with a light that reads them.
    /// Returns false without room on the device; retries after Retry::kFrames such frames.
    bool provide_caster_triangles();

    struct MeshRange {
        std::int32_t base_vertex = 0;
        std::uint32_t first_index = 0;  // start of the mesh in the common index buffer
        std::uint32_t first_submesh = 0, submesh_count = 0;
        std::uint64_t triangles = 0;
        float most_reflected = 0.0f;  // maximum share of incident light toward any viewer (most_reflected())
        bool solid = false;  // closed, wound outward, opaque and single-sided throughout: a ray from outside never hits
                             // a back face first
    };
    struct SubmeshRange {
        std::uint32_t first_index = 0, index_count = 0;
        std::uint32_t material = 0;
    };
    struct MaterialInfo {
        gl::TextureHandle texture{};  // a white texel if the material has none
        gl::SamplerHandle sampler{};
        std::uint32_t uniform_offset = 0;
        assets::AlphaMode alpha_mode = assets::AlphaMode::opaque;
        bool double_sided = false;
        bool unlit = false;
    };

    const MeshRange& mesh(std::uint32_t index) const { return meshes_[index]; }
    const SubmeshRange& submesh(std::uint32_t index) const { return submeshes_[index]; }
    const MaterialInfo& material(std::uint32_t index) const { return materials_[index]; }
    bool any_unlit() const { return any_unlit_; }           // any material is unlit
    float most_emissive() const { return most_emissive_; }  // maximum over lit materials and channels
    const assets::MeshLibrary& library() const { return *library_; }
    std::size_t mesh_count() const { return meshes_.size(); }
    /// Mesh's own lists, in the pose of the device after the recorded uploads.
    struct MeshShape {
        const std::vector<assets::Vertex>* vertices = nullptr;
        const std::vector<std::uint32_t>* indices = nullptr;
        std::uint64_t version = 0;  // pose version; 0: at rest
    };
    MeshShape shape(std::uint32_t mesh) const;

    gl::BufferHandle vertices() const { return vertices_; }
    gl::BufferHandle indices() const { return indices_; }
    /// Returns a buffer of vec4 per vertex, white for meshes without colours; {0}: no mesh has colours. Read as texels
    /// at bindings::kColourUnit by programs compiled with COLOURED.
    gl::BufferHandle colours() const { return colours_; }
    /// Returns an InstanceRecord per slot, read as texels at bindings::kInstanceUnit.
    gl::BufferHandle instances() const { return instances_; }
    /// Returns a vec4 per triangle of `indices`, in model space, read as texels at bindings::kTriangleNormalUnit.
    gl::BufferHandle triangle_normals() const { return triangle_normals_; }
    /// Returns a CasterTriangle per triangle of `indices`, read as texels; {0} until provided.
    gl::BufferHandle caster_triangles() const { return caster_triangles_; }
    /// Returns the masks of masked triangles for shaders/ray_tracing/alpha_mask.glsl; {0}: none is masked, or not
    /// provided.
    gl::BufferHandle caster_masks() const { return caster_masks_; }
    gl::BufferHandle material_uniforms() const { return material_uniforms_; }

private:
    /// Deformable mesh in its pose on the device.
    struct Bent {
        std::uint32_t mesh = 0;
        std::uint64_t version = 0;  // pose version; 0: at rest; kUnknown: contents of the device are unknown
        std::vector<assets::Vertex> vertices;
    };
    static constexpr std::uint64_t kUnknown = ~std::uint64_t{0};
    GpuScene() = default;
    void release();
    void update_instances(const SceneSnapshot& snapshot, gl::CommandList& list);
    void update_poses(const SceneSnapshot& snapshot, gl::CommandList& list);
    void upload(const Bent& bent, gl::CommandList& list);
    void put_corners(const Bent& bent);

    gl::Device* device_ = nullptr;
    const assets::MeshLibrary* library_ = nullptr;
    bool any_unlit_ = false;
    float most_emissive_ = 0.0f;
    gl::BufferHandle vertices_{}, indices_{}, instances_{}, triangle_normals_{}, material_uniforms_{};
    gl::BufferHandle caster_triangles_{}, caster_masks_{}, colours_{};
    std::vector<Bent> bent_;                        // all deformable meshes, sorted by mesh
    std::vector<CasterTriangle> triangle_records_;  // whole library, if it has deformable meshes and they are provided
    std::vector<glm::vec4> normal_scratch_;
    Retry triangles_retry_;
    std::uint64_t triangles_asked_ = 0;
    std::uint32_t instance_capacity_ = 0;
    bool upload_all_ = false;
    std::vector<InstanceRecord> records_;
    std::vector<gl::TextureHandle> textures_;
    std::vector<gl::SamplerHandle> samplers_;
    std::vector<MeshRange> meshes_;
    std::vector<SubmeshRange> submeshes_;
    std::vector<MaterialInfo> materials_;
};

}  // namespace gnomon
