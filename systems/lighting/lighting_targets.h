#pragma once
#include <cstdint>
#include <glm/vec2.hpp>

#include "engine/gl/device.h"

namespace gnomon::lighting {

/// Edge of the luminance target: 65536 samples suffice for an exposure. kSide in shaders/lighting/post/luminance.frag.
inline constexpr std::uint32_t kLuminanceSide_px = 256;
inline constexpr std::uint32_t kLuminanceTopMip = 8;  // log2 of the side

/// Textures and framebuffers for one picture size. Owns them.
class LightingTargets {
public:
    explicit LightingTargets(gl::Device& device) : device_(device) {}
    ~LightingTargets() { release(); }
    LightingTargets(const LightingTargets&) = delete;
    LightingTargets& operator=(const LightingTargets&) = delete;

    /// Creates everything at this size. Returns false on failure; the old targets then remain usable if the size is
    /// equal.
    bool resize(glm::uvec2 size_px);
    /// Creates the visibility target on first use, because few pictures need it.
    bool ensure_visibility();
    /// Creates the target of a light's tint on first use.
    bool ensure_tint();
    /// Creates or frees the target for exact surface positions. Returns false without room.
    bool provide_places(bool wanted);
    /// Creates or frees a second depth of the surfaces with the light's sum, for pixels that a light's first draw
    /// leaves to its second. Returns false without room; lights then use one draw.
    bool provide_undecided(bool wanted);
    glm::uvec2 size_px() const { return size_px_; }
    std::uint64_t place_bytes() const;                // memory of `places`
    gl::Failure failure() const { return failure_; }  // last creation

    gl::TextureHandle depth{}, colour{}, normals{}, material{}, light_sum{}, luminance{}, picture{}, visibility{},
        tint{}, places{}, undecided{};
    gl::TargetHandle surface_target{}, light_target{}, luminance_target{}, picture_target{}, visibility_target{},
        tint_target{}, places_target{},  // the surfaces including places
        undecided_target{};              // light_sum, with `undecided`

private:
    void release();
    void release_places();
    void release_undecided();
    bool make(gl::TextureHandle& texture, const char* label, gl::Format format, std::uint32_t width,
              std::uint32_t height, std::uint32_t mips = 1);
    bool make(gl::TargetHandle& target, const char* label, std::initializer_list<gl::TextureHandle> colours,
              gl::TextureHandle depth_texture);

    gl::Device& device_;
    glm::uvec2 size_px_{0, 0};
    gl::Failure failure_ = gl::Failure::none;
};

}  // namespace gnomon::lighting
