#pragma once
#include <glm/vec2.hpp>

#include "engine/gl/device.h"
#include "systems/retry.h"

namespace gnomon::lighting {

/// Texels of the picture in which the rays of a list are drawn and their answers lie: room for each pixel of a picture
/// of up to 2^28 (16384 x 16384), neither edge longer than 16384. GLSL twin:
/// shaders/lighting/trace/ray_list_layout.glsl.
glm::uvec2 ray_list_size_px(glm::uvec2 picture_px);

/// Pixels of which a light's map is not certain (docs/exact.md), gathered so that rays cost no others: what the map
/// says of each pixel, the list of those for rays, and their answers. One light after the other uses it. Holds nothing
/// unless one asks for it.
class RayList {
public:
    explicit RayList(gl::Device& device);
    ~RayList() { release(); }
    RayList(const RayList&) = delete;
    RayList& operator=(const RayList&) = delete;

    /// Made when wanted, gone when not. `depth`: of the picture's surfaces. False: there is no room; asked again later.
    bool provide(bool wanted, glm::uvec2 size_px, gl::TextureHandle depth);
    explicit operator bool() const { return static_cast<bool>(answer_target_); }
    std::uint64_t bytes() const { return bytes_; }

    /// Where the map's verdicts go: records the beginning of their pass. `end_verdicts` ends it.
    void begin_verdicts(gl::CommandList& list) const;
    void end_verdicts(gl::CommandList& list) const;
    /// A pass of one ray for each listed pixel.
    void record_rays(gl::ProgramHandle program, gl::CommandList& list) const;
    /// Binds both for the pass that reads them (shaders/lighting/trace/ray_results.glsl).
    void bind_answers(gl::CommandList& list) const;
    /// After it: another light's go into the same textures.
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
    std::uint64_t asked_ = 0;
};

}  // namespace gnomon::lighting
