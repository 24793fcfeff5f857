#pragma once
#include <imgui.h>

#include <glm/vec2.hpp>
#include <memory>

#include "engine/gl/device.h"
#include "gnomon/result.h"
#include "systems/growing_buffer.h"

namespace gnomon::game {

/// Returns ImGui's name for a texture of the device, rgba8 or srgb8_a8.
ImTextureID image_of(gl::TextureHandle texture);

/// Draws Dear ImGui's lists through the device, so that panels look alike in a window, without one and in screenshots.
class Overlay {
public:
    /// Takes the font of the current ImGui context. `device` must outlive the overlay. Error: rule "gui.device".
    static Result<std::unique_ptr<Overlay>> create(gl::Device& device);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    /// Records `data` over the picture in `target`, which encodes sRGB and is `size_px` large. Records nothing if the
    /// device has no memory for it.
    void record(const ImDrawData& data, gl::TargetHandle target, glm::uvec2 size_px, gl::CommandList& list);

private:
    explicit Overlay(gl::Device& device);
    bool reserve(const ImDrawData& data);

    gl::Device& device_;
    gl::TextureHandle font_{};
    gl::SamplerHandle sampler_{};
    gl::ProgramHandle program_{};
    GrowingBuffer vertices_, indices_, items_;
};

}  // namespace gnomon::game
