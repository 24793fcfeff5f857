#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/gl/device.h"
#include "engine/rays/bvh.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/growing_buffer.h"

namespace gnomon::visibility {

/// Head of the tree of translucent triangles; matches the first words of shaders/shadow/lookup/tint/tint_tree.glsl.
/// Offsets are words from the buffer's start.
struct TintHead {
    glm::vec3 anchor_high{0.0f};
    std::uint32_t nodes = 0;  // number; they follow the head
    glm::vec3 anchor_low{0.0f};
    std::uint32_t triangles = 0;  // offset
    float reach_m = 0.0f;         // distance of corners from the anchor, along any axis
    std::uint32_t spare[3] = {};
};
static_assert(sizeof(TintHead) == 48);

/// Translucent triangle, placed in the world; matches TintTriangle there.
struct TintTriangle {
    glm::vec3 a{0.0f}, b{0.0f}, c{0.0f};  // from the anchor, metres
    std::uint32_t layers = 0;             // bits of the lights that it tints
    std::uint32_t material = 0;           // offset of its TintMaterial
    float uv[6] = {};
    float colours[12] = {};  // colours of its corners; 1 where the mesh has none
};
static_assert(sizeof(TintTriangle) == 116);

/// Material of such triangles; matches TintMaterial there.
struct TintMaterial {
    float base_colour[4] = {};
    float through[3] = {};      // Material::transmission
    std::uint32_t blended = 0;  // 1: alpha is the covered share
    float cutoff = -1.0f;       // below 0: not masked
    float metallic = 0.0f;
    std::uint32_t texels = ~0u;  // offset of sRGB bytes, a word per texel; ~0: no texture
    std::uint32_t width = 0, height = 0;
    std::uint32_t wrap_u = 0, wrap_v = 0;  // assets::TextureWrap
    std::uint32_t linear = 0;
};
static_assert(sizeof(TintMaterial) == 64);

/// Tree over the translucent triangles of a scene, with their materials and textures, in one storage buffer for rays in
/// shaders. There are few of them: any change of the scene builds it again. Uses no memory before the first
/// update().
class TintScene {
public:
    explicit TintScene(gl::Device& device) : buffer_(device, "translucent triangles") {}

    /// Updates the buffer to the snapshot. Call it in each frame with rays that may meet translucent casters. Returns
    /// false without room on the device.
    bool update(const SceneSnapshot& scene, const GpuScene& gpu, gl::CommandList& list);
    /// Frees everything, when no such ray is traced.
    void release();
    /// Notes the result of a submission. `executed` false: the next update() writes everything.
    void submitted(bool executed) { written_ = written_ && executed; }

    gl::BufferHandle buffer() const { return buffer_.handle(); }
    std::uint64_t bytes() const { return buffer_.bytes(); }

private:
    void gather(const SceneSnapshot& scene, const GpuScene& gpu);
    void add_instance(const InstanceItem& item, const GpuScene& gpu, const glm::dvec3& anchor_ws_m);
    std::uint32_t material_of(const GpuScene& gpu, std::uint32_t material);
    std::uint32_t texels_of(const assets::MeshLibrary& library, std::int32_t texture);

    GrowingBuffer buffer_;
    std::vector<TintTriangle> triangles_;
    std::vector<std::uint32_t> shading_;  // materials and texels
    std::vector<std::uint32_t> material_places_, texture_places_;
    std::vector<std::uint32_t> words_;
    std::uint64_t version_ = 0, library_version_ = 0;
    bool written_ = false;
};

}  // namespace gnomon::visibility
