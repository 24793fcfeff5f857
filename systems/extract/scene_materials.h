#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <tuple>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/assets.h"
#include "systems/device_arrays.h"
#include "systems/retry.h"

namespace gnomon {

/// Material on the device; matches MaterialBlock in shaders/common/material.glsl (std140).
struct MaterialRecord {
    float base_colour[4];
    float emissive[4];                        // rgb; 1: unlit
    float metallic, roughness, alpha_cutoff;  // alpha_cutoff < 0: not masked
    float has_texture;
};
static_assert(sizeof(MaterialRecord) == 48);

/// What of a material's drawing its users need to know.
struct MaterialInfo {
    gl::TextureHandle texture{};  // a white texel if the material has none
    gl::SamplerHandle sampler{};
    std::uint32_t uniform_offset = 0;
    assets::AlphaMode alpha_mode = assets::AlphaMode::opaque;
    bool double_sided = false;
    bool unlit = false;
    bool transmits = false;  // assets::transmits()
    glm::vec3 transmission{0.0f};
};

/// Materials and textures of a library on the device. Owns the objects.
class SceneMaterials {
public:
    SceneMaterials() = default;
    SceneMaterials(SceneMaterials&& other) noexcept { *this = std::move(other); }
    SceneMaterials& operator=(SceneMaterials&& other) noexcept;
    ~SceneMaterials() { release(); }

    struct Failed {
        const char* what = "";
        gl::Failure failure = gl::Failure::none;
    };
    /// Uploads all of a library, which must outlive the object.
    Failed create(gl::Device& device, const assets::MeshLibrary& library);
    /// Follows materials and textures that came to the library or went, as far as the device has room.
    void follow(gl::CommandList& list);
    /// Notes that the recorded uploads were executed, or that they are to be repeated.
    void submitted(bool executed);

    /// Returns true if the device has the material.
    bool has(std::uint32_t material) const { return material < uploaded_.size() && uploaded_[material].there; }
    const MaterialInfo& material(std::uint32_t index) const { return materials_[index]; }
    /// Returns the number of slots of materials.
    std::size_t count() const { return materials_.size(); }
    /// Returns a number that grows whenever material() gives something else.
    std::uint64_t version() const { return version_; }
    bool any_masked() const { return any_masked_; }
    bool any_unlit() const { return any_unlit_; }
    bool any_transmits() const { return any_transmits_; }
    float most_emissive() const { return most_emissive_; }
    gl::BufferHandle uniforms() const { return uniforms_.buffer(0); }

private:
    /// What of a slot of the library is on the device.
    struct Uploaded {
        std::uint64_t version = 0;  // the library's, of the slot
        bool there = false;
    };
    struct UploadedTexture {
        gl::TextureHandle texture{};  // {0}: it has no texels
        Uploaded state;
    };
    gl::Failure make_texture(std::size_t texture);
    gl::Failure make_info(std::size_t material);
    gl::Failure make_lacking(gl::CommandList& list);
    gl::Failure sampler_for(assets::TextureWrap u, assets::TextureWrap v, bool linear, gl::SamplerHandle& sampler);
    void note_changes();
    void note_lights();
    void write(std::size_t material, gl::CommandList& list);
    void release();

    gl::Device* device_ = nullptr;
    const assets::MeshLibrary* library_ = nullptr;
    DeviceArrays uniforms_;
    gl::TextureHandle white_{};
    std::vector<UploadedTexture> textures_;
    std::vector<gl::TextureHandle> outgrown_;  // freed once the list was submitted
    std::map<std::tuple<assets::TextureWrap, assets::TextureWrap, bool>, gl::SamplerHandle> samplers_;
    std::vector<MaterialInfo> materials_;
    std::vector<Uploaded> uploaded_;  // by material
    std::vector<std::size_t> unwritten_, unconfirmed_;
    bool lacks_ = false;  // some material or texture is not on the device
    std::uint64_t version_ = 0;
    bool any_masked_ = false, any_unlit_ = false, any_transmits_ = false;
    float most_emissive_ = 0.0f;
    std::uint64_t seen_ = 0;
    Retry retry_;
    std::uint64_t calls_ = 0;
};

}  // namespace gnomon
