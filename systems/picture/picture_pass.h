#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>

#include "engine/gl/device.h"

namespace gnomon::picture {

/// Picture that passes read and write: as a display shows it, encoded in 8 bits.
struct FinishedPicture {
    gl::TextureHandle texture{};
    gl::TargetHandle target{};
    glm::uvec2 size_px{0, 0};
};

/// Makes a program that is drawn over a whole picture, of a file under shaders/. {0}: it cannot be made.
gl::ProgramHandle make_program(gl::Device& device, std::string_view label, std::string_view fragment,
                               std::span<const std::string> defines = {});

/// Full-screen pass that reads one texture.
struct PicturePass {
    gl::ProgramHandle program{};
    gl::TextureHandle source{};
    gl::SamplerHandle sampler{};
    gl::TargetHandle target{};
    gl::Blend blend = gl::Blend::off;
    bool clears = false;
    gl::BufferHandle uniforms{};  // at bindings::kSampleBlock; {0}: none
    std::uint32_t uniform_bytes = 0;
};
/// Records it over a picture of that size.
void record_pass(const PicturePass& pass, glm::uvec2 size_px, gl::CommandList& list);

}  // namespace gnomon::picture
