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

/// Matches InstanceRecord in shaders/common/instances.glsl. 64 bytes.
/// w components hold the high part of the translation; `low` its low part and the layers it receives shadows of.
struct InstanceRecord {
    float basis_x_high_x[4], basis_y_high_y[4], basis_z_high_z[4];
    float low_layers[4];
};
static_assert(sizeof(InstanceRecord) == 64);

/// Matches MaterialBlock in shaders/common/material.glsl (std140).
struct MaterialRecord {
    float base_colour[4];
    float emissive[4];                        // rgb; 1: unlit
    float metallic, roughness, alpha_cutoff;  // alpha_cutoff < 0: not masked
    float has_texture;
};
static_assert(sizeof(MaterialRecord) == 48);

/// What the surfaces' geometric normals come from: of each triangle of `indices`, zero where it has no area. In double:
/// the cross product of float edges is exact enough that the normal is right to float rounding. The bits of w say what
/// that rounded away, to 2^-35 along each axis: three signed whole numbers of 10 bits, x lowest, of which 511 are
/// 2^-25 (plane_normal() in shaders/lighting/gbuffer/surface_position_f64.glsl).
void append_plane_normals(std::span<const assets::Vertex> vertices, std::span<const std::uint32_t> indices,
                          std::vector<glm::vec4>& normals);

/// Bound of shaders/lighting/lights/brdf.glsl over all directions, its cosine included, per unit of light: Lambert's
/// term, and GGX with D <= 1 / (pi alpha^2), V n.l <= 1 / (2 alpha), F <= 1.
float most_reflected(const assets::Material& material);

/// Texture units of shaders/common/instance_buffer.glsl and shaders/lighting/gbuffer/triangle_normals.glsl: above all
/// that maps and rays use.
inline constexpr std::uint32_t kInstanceUnit = 14, kTriangleNormalUnit = 15;
/// Of shaders/common/vertex_colour.glsl: one that passes over meshes leave free.
inline constexpr std::uint32_t kColourUnit = 3;

/// Meshes, materials, textures and instance records on the device. Owns what it makes.
class GpuScene {
public:
    /// `library` must outlive the scene: what only some lights ask for is made of it later. Error (rule "gpu.scene") if
    /// the device cannot hold the library; nothing is left behind then.
    static Result<GpuScene> create(gl::Device& device, const assets::MeshLibrary& library);
    GpuScene(GpuScene&&) noexcept;
    GpuScene& operator=(GpuScene&&) noexcept;
    ~GpuScene();

    /// Records the upload of changed instance records, and of meshes whose pose changed: each is bent once, whoever
    /// draws it how often; grows the instance buffer when needed.
    /// False if it could not grow: instances beyond its size must not be drawn (see capacity()).
    bool update(const SceneSnapshot& snapshot, gl::CommandList& list);
    std::uint32_t capacity() const { return instance_capacity_; }
    /// To be called when a submission failed: what it was to upload is uploaded again by the next update().
    void forget_uploads();
    /// How many meshes the last update() bent.
    std::uint32_t bent_meshes() const { return bent_meshes_; }

    /// Makes caster_triangles() and caster_masks() where there are none; to be called each frame that a light reads
    /// them. False: the device has no room, which is asked again after Retry::kFrames such frames.
    bool provide_caster_triangles();

    struct MeshRange {
        std::int32_t base_vertex = 0;
        std::uint32_t first_index = 0;  // of the mesh in the common index buffer
        std::uint32_t first_submesh = 0, submesh_count = 0;
        std::uint64_t triangles = 0;
        float most_reflected = 0.0f;  // of what falls on it, toward any viewer (most_reflected())
        bool solid = false;  // closed and wound outward, all of it opaque and single-sided: no ray from outside meets a
                             // back face first
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
    bool any_unlit() const { return any_unlit_; }           // of the materials
    float most_emissive() const { return most_emissive_; }  // of the lit materials, in any colour
    const assets::MeshLibrary& library() const { return *library_; }
    std::size_t mesh_count() const { return meshes_.size(); }
    /// A mesh's own lists, bent as the device has them once the recorded uploads are done.
    struct MeshShape {
        const std::vector<assets::Vertex>* vertices = nullptr;
        const std::vector<std::uint32_t>* indices = nullptr;
        std::uint64_t version = 0;  // of the pose; 0: at rest
    };
    MeshShape shape(std::uint32_t mesh) const;

    gl::BufferHandle vertices() const { return vertices_; }
    gl::BufferHandle indices() const { return indices_; }
    /// vec4 per vertex, white where a mesh has no colours, to be read as texels at kColourUnit by programs compiled
    /// with COLOURED. {0}: no mesh has any.
    gl::BufferHandle colours() const { return colours_; }
    /// InstanceRecord per slot, to be read as texels at kInstanceUnit.
    gl::BufferHandle instances() const { return instances_; }
    /// vec4 per triangle of `indices`, in model space, to be read as texels at kTriangleNormalUnit.
    gl::BufferHandle triangle_normals() const { return triangle_normals_; }
    /// CasterTriangle per triangle of `indices`, to be read as texels; {0} until provided.
    gl::BufferHandle caster_triangles() const { return caster_triangles_; }
    /// The masks of those that are masked, as shaders/ray_tracing/alpha_mask.glsl reads them; {0}: none is, or not
    /// provided.
    gl::BufferHandle caster_masks() const { return caster_masks_; }
    gl::BufferHandle material_uniforms() const { return material_uniforms_; }

private:
    /// A mesh that bends, as the device has it.
    struct Bent {
        std::uint32_t mesh = 0;
        std::uint64_t version = 0;  // of the pose; 0: at rest; kUnknown: what the device has is not known
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
    std::vector<Bent> bent_;                        // by rising mesh: all of the library that have a deformer
    std::vector<CasterTriangle> triangle_records_;  // of the whole library, if it has such meshes and they are provided
    std::vector<glm::vec4> normal_scratch_;
    std::uint32_t bent_meshes_ = 0;
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
