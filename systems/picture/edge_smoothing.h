#pragma once
#include <cstdint>

#include "engine/gl/device.h"
#include "systems/picture/picture_pass.h"
#include "systems/retry.h"

namespace gnomon::picture {

/// Smooths stair-steps of a picture with one sample per pixel, from the picture alone (shaders/picture/
/// smooth_edges.frag). Makes its objects on first use, and owns them.
class EdgeSmoothing {
public:
    explicit EdgeSmoothing(gl::Device& device) : device_(device) {}
    ~EdgeSmoothing() { release(); }
    EdgeSmoothing(const EdgeSmoothing&) = delete;
    EdgeSmoothing& operator=(const EdgeSmoothing&) = delete;

    /// Records it over the picture. Does nothing without room or program.
    void record(const FinishedPicture& picture, gl::CommandList& list);
    /// Frees everything, while no picture is smoothed.
    void release();

private:
    bool provide(glm::uvec2 size_px);

    gl::Device& device_;
    gl::ProgramHandle program_{};
    gl::SamplerHandle sampler_{};
    gl::TextureHandle copy_{};
    glm::uvec2 size_px_{0, 0};
    std::uint64_t frame_ = 0;  // clock of the retries
    Retry retry_;
};

}  // namespace gnomon::picture
