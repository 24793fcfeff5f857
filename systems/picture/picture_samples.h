#pragma once
#include <cstdint>
#include <glm/vec2.hpp>

#include "engine/gl/device.h"
#include "systems/picture/picture_pass.h"
#include "systems/retry.h"

namespace gnomon::picture {

/// Sum of a still picture's samples. Samples are averaged as a display shows them: after the tone curve, in linear
/// light. The mean before it would leave steps at bright edges, because one bright sample outweighs all others. Owns
/// its device objects; moving pictures cost nothing.
class PictureSamples {
public:
    explicit PictureSamples(gl::Device& device) : device_(device) {}
    ~PictureSamples() { release(); }
    PictureSamples(const PictureSamples&) = delete;
    PictureSamples& operator=(const PictureSamples&) = delete;

    /// What a frame draws of its picture.
    enum class Draws : std::uint8_t {
        alone,   // the picture by itself
        sample,  // one more sample
        nothing  // all samples are there
    };
    /// Begins a frame. `unchanged`: its picture would equal the last frame's, sample for sample. `most`: wanted samples
    /// per pixel. `transparent`: the picture's alpha is coverage. Starts with the first sample after a change.
    Draws begin(bool unchanged, std::uint32_t most, glm::uvec2 size_px, bool transparent);
    /// Returns the place of this frame's sample in each pixel, from its middle, pixels.
    glm::dvec2 place_px() const;
    /// Returns the number of this frame's sample, from 0: samples differ by their noise as well.
    std::uint32_t number() const { return draws_ == Draws::sample ? count_ : 0; }
    /// Records the frame's part, after its picture, as begin() returned it: adds a sample, and writes the mean.
    void record(const FinishedPicture& picture, gl::CommandList& list);
    /// Reports whether all that was recorded was executed. Without that the sum is void.
    void submitted(bool drawn);
    /// Discards the sum, because its samples differ from those to come. This frame's picture stands alone.
    void restart() {
        count_ = 0;
        draws_ = Draws::alone;
    }
    /// Returns the samples per pixel in the picture, after record(); 1 if it shows one sample.
    std::uint32_t count() const { return draws_ == Draws::alone ? 1 : count_; }

private:
    bool provide(glm::uvec2 size_px, bool transparent);
    void release();

    gl::Device& device_;
    gl::ProgramHandle add_{}, mean_{};
    gl::SamplerHandle sampler_{};
    gl::TextureHandle sum_{};
    gl::TargetHandle sum_target_{};
    gl::BufferHandle count_buffer_{};  // {0}: opaque pictures count their samples in the sum's alpha
    glm::uvec2 size_px_{0, 0};
    Draws draws_ = Draws::alone;
    std::uint32_t count_ = 0;  // samples in the sum
    std::uint64_t frame_ = 0;  // clock of the retries
    Retry retry_;
};

}  // namespace gnomon::picture
