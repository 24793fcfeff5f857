#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/growing_buffer.h"
#include "systems/lighting/depth_picture.h"
#include "systems/lighting/edge_pass.h"
#include "systems/lighting/light_lookup.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lighting {

/// Matches ImportBlock in shaders/lighting/mask/import_surfaces.frag (std140).
struct ImportRecord {
    glm::vec4 depth{0.0f};
    glm::ivec4 normals{0};
};
static_assert(sizeof(ImportRecord) == 32);

/// Returns the camera's record for a picture with that lens: `camera`, with the lens in place of the symmetric view
/// that shadows are fitted to.
shadow::CameraRecord with_lens(const shadow::CameraRecord& camera, const DepthPicture& picture);

/// Returns the pixels of `picture` that `area` covers. `area` is a rectangle of the symmetric view `consumer`, which
/// contains the picture.
gl::Rect in_picture(const gl::Rect& area, const ConsumerItem& consumer, const DepthPicture& picture);

/// Inputs of a mask. `layers`: an index into inputs.lights per layer, or MaskPass::kNoLight.
struct MaskInputs {
    const shadow::LightingInputs& inputs;
    const SceneSnapshot& scene;
    const GpuScene& gpu;
    const DepthPicture& picture;
    std::span<const std::uint32_t> layers;
    std::uint32_t noise_round = 0;  // shadow::in_round()
};

/// Returns the part of the picture that may show the light, in pixels of the view that shadows are fitted to.
gl::Rect masked_area(const shadow::LitArea& area, const DepthPicture& picture);
/// Returns a lower bound on the depths there.
float masked_depth(const shadow::LitArea& area, const DepthPicture& picture);

/// Returns the pixels of the picture that the lights of the layers reach, and their neighbours, in one rectangle.
gl::Rect reached_pixels(const MaskInputs& in);

/// Visibility of lights over another renderer's picture: a texture with a layer per light and sample, 8 bits each. One
/// object per view. Owns its device objects; programs are shared.
class MaskPass {
public:
    MaskPass(gl::Device& device, LightPrograms& programs)
        : device_(device), programs_(programs), edges_(device), uniforms_(device, "mask uniforms") {}
    ~MaskPass() { release(); }
    MaskPass(const MaskPass&) = delete;
    MaskPass& operator=(const MaskPass&) = delete;

    /// Layer without a light: it is 1 everywhere.
    static constexpr std::uint32_t kNoLight = ~0u;

    /// Records the mask. Pixels without a surface or out of the light's reach are 0. Lights without a
    /// shadow are 1. Returns false without room on the device: nothing is recorded, and outcome.failure has the reason.
    /// Lights that fall back are in outcome.failures.
    bool record(const MaskInputs& in, gl::CommandList& list, shadow::LightingOutcome& outcome);

    /// Returns the mask, r8; {0} before the first record(). Another texture after a change of size or number of layers.
    gl::TextureHandle texture() const { return mask_; }
    /// Returns the colours that translucent casters let through, rgba8, with the same layers. {0}: no light of the last
    /// record() has such casters, or the device has no room for them.
    gl::TextureHandle tint_texture() const { return tints_; }
    std::uint32_t layer_count() const { return static_cast<std::uint32_t>(targets_.size()); }

private:
    gl::Failure prepare(const DepthPicture& picture, std::size_t layers, std::size_t lights);
    gl::Failure make_surfaces(glm::uvec2 size_px);
    gl::Failure make_layers(std::size_t layers);
    void provide_undecided(bool wanted);
    void upload(const MaskInputs& in, gl::CommandList& list);
    void bind_camera(std::uint32_t sample, gl::CommandList& list) const;
    void import_material(const DepthPicture& picture, gl::CommandList& list) const;
    gl::ProgramHandle import_program(const DepthPicture& picture) const;
    void import(const DepthPicture& picture, const gl::Rect& area, std::uint32_t sample, gl::CommandList& list) const;
    LightProgram program_of(const shadow::LightingLight& light);
    void record_light(const MaskInputs& in, std::uint32_t layer, std::uint32_t sample, const LightProgram& program,
                      const gl::Rect& area, gl::CommandList& list) const;
    void record_edges(const MaskInputs& in, std::uint32_t layer, std::uint32_t sample, const LightProgram& program,
                      const gl::Rect& area, gl::CommandList& list) const;
    void bind_inputs(const MaskInputs& in, std::uint32_t layer, std::uint32_t sample, const LightProgram& program,
                     gl::CommandList& list) const;
    void bind_shares(gl::CommandList& list) const;
    void record_layers(const MaskInputs& in, std::uint32_t sample, gl::CommandList& list);
    void provide_tints(const MaskInputs& in);
    void record_tints(const MaskInputs& in, std::uint32_t sample, gl::CommandList& list);
    void release_tints();
    void release_undecided();
    void release_layers();
    void release();

    gl::Device& device_;
    LightPrograms& programs_;
    EdgePass edges_;
    GrowingBuffer uniforms_;
    gl::TextureHandle depth_{}, normals_{}, material_{}, mask_{};
    gl::TargetHandle surfaces_{}, same_material_{};
    std::vector<gl::TargetHandle> targets_;            // one per layer of the mask, with depth_
    gl::TextureHandle undecided_{};                    // depth of the pixels that a light's first draw has left
    std::vector<gl::TargetHandle> undecided_targets_;  // one per layer, with undecided_; none: each light is one draw
    gl::TextureHandle tints_{};
    std::vector<gl::TargetHandle> tint_targets_;  // one per layer of the mask
    glm::uvec2 size_px_{0, 0};
    gl::SamplerHandle sampler_{};
    std::uint32_t import_offset_ = 0, sample_stride_ = 0, lights_offset_ = 0, light_stride_ = 0, kept_offset_ = 0;
    std::vector<std::byte> bytes_;
};

}  // namespace gnomon::lighting
