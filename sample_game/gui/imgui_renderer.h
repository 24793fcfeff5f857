#pragma once
#include <imgui.h>

#include <cstddef>
#include <glm/vec2.hpp>
#include <memory>

#include "gnomon/result.h"

namespace gnomon::game {

/// Makes a GL_TEXTURE_2D of `size_px` of four bytes a texel, row by row from the bottom. `encoded`: colours are sRGB.
/// Returns 0 without memory for it.
unsigned make_image(const char* label, glm::uvec2 size_px, const void* rgba8, bool encoded);
/// Deletes such a texture; 0: none.
void destroy_image(unsigned texture);

/// Returns ImGui's name for a texture of the current context.
ImTextureID image_of(unsigned texture);

/// Draws Dear ImGui's lists into a picture of Gnomon's, so that panels look alike in a window, without one and in
/// screenshots. An example of a program's own OpenGL over Frame::picture_texture(): ImGui's own backend writes colours
/// as they are, and this picture encodes them.
class Overlay {
public:
    /// Takes the font of the current ImGui context. The OpenGL context must be current in every call. Error: rule
    /// "gui.device".
    static Result<std::unique_ptr<Overlay>> create();
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    /// Draws `data` over `picture`, a GL_TEXTURE_2D of GL_SRGB8_ALPHA8, `size_px` large; nothing without memory for it.
    /// Leaves what it draws with bound: Gnomon needs no state.
    void draw(const ImDrawData& data, unsigned picture, glm::uvec2 size_px);

private:
    Overlay() = default;
    bool upload(const ImDrawData& data);

    unsigned font_ = 0, sampler_ = 0, program_ = 0, framebuffer_ = 0, array_ = 0, vertices_ = 0, indices_ = 0;
};

}  // namespace gnomon::game
