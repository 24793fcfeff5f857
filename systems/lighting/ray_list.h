#pragma once
#include <glm/vec2.hpp>

#include "engine/gl/device.h"
#include "systems/retry.h"

namespace gnomon::lighting {

/// Computes the size of the texture for a list's rays and their results. It has a texel per pixel of a picture of up to
/// 2^28 pixels (16384 x 16384), neither edge longer than 16384. GLSL twin: shaders/lighting/trace/ray_list_layout.glsl.
glm::uvec2 ray_list_size_px(glm::uvec2 picture_px);

/// List of pixels that a light's map leaves undecided (docs/explanation/exact.md), so that rays cost no others.
/// Contains the map's verdict per pixel, the pixels for rays, and their results. Lights use it one after the other.
/// Uses no memory until needed.
class RayList {
public:
    explicit RayList(gl::Device& device);
    ~RayList() { release(); }
    RayList(const RayList&) = delete;
    RayList& operator=(const RayList&) = delete;

    /// Creates or frees the list. `depth`: of the picture's surfaces. Returns false without room, and retries later.
    bool provide(bool wanted, glm::uvec2 size_px, gl::TextureHandle depth);
    explicit operator bool() const { return static_cast<bool>(answer_target_); }
    std::uint64_t bytes() const { return bytes_; }

    /// Begins the pass that writes the map's verdicts; end_verdicts() ends it.
    void begin_verdicts(gl::CommandList& list) const;
    void end_verdicts(gl::CommandList& list) const;
    /// Records a pass of one ray per listed pixel.
    void record_rays(gl::ProgramHandle program, gl::CommandList& list) const;
    /// Binds verdicts and results for the pass that reads them (shaders/lighting/trace/ray_results.glsl).
    void bind_answers(gl::CommandList& list) const;
    /// Unbinds them, because the next light writes the same textures.
    void unbind_answers(gl::CommandList& list) const;

private:
    void release();
    bool make(glm::uvec2 size_px, gl::TextureHandle depth);

    gl::Device& device_;
    glm::uvec2 size_px_{0, 0};
    std::uint64_t bytes_ = 0;
    gl::TextureHandle depth_{}, verdicts_{}, answers_{};
    gl::TargetHandle verdict_target_{}, answer_target_{};
    gl::BufferHandle pixels_{};
    Retry retry_;
    std::uint64_t calls_ = 0;
};

}  // namespace gnomon::lighting
