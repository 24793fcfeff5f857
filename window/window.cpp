#include "gnomon/window.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "engine/image/encode_image.h"
#include "engine/image/srgb.h"
#include "engine/platform/context.h"

namespace gnomon {

struct Window::State {
    WindowOptions options;
    std::unique_ptr<platform::Context> context;
    platform::Window* window = nullptr;  // null: headless
    glm::uvec2 size_px{0, 0};
    GLuint framebuffer = 0, colour = 0, depth = 0;
    GLuint shown = 0;          // framebuffer around a picture of the program's own
    std::uint32_t frames = 0;  // begun
    Input no_input = {};
    bool closed = false;
    std::chrono::steady_clock::time_point start{};

    bool make_picture(glm::uvec2 size);
    void release_picture();
    GLuint framebuffer_of(GLuint picture);
    bool is_last() const { return options.frames > 0 && frames >= options.frames; }
};

/// Makes the picture at this size. Returns false if the device refuses.
bool Window::State::make_picture(glm::uvec2 size) {
    if (framebuffer != 0 && size == size_px) return true;
    release_picture();
    size_px = size;
    if (!options.own_picture) return true;
    const auto width = static_cast<GLsizei>(size.x), height = static_cast<GLsizei>(size.y);
    glCreateTextures(GL_TEXTURE_2D, 1, &colour);
    glTextureStorage2D(colour, 1, GL_SRGB8_ALPHA8, width, height);
    glCreateTextures(GL_TEXTURE_2D, 1, &depth);
    glTextureStorage2D(depth, 1, GL_DEPTH_COMPONENT32F, width, height);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, colour, 0);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
    return glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

void Window::State::release_picture() {
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &colour);
    glDeleteTextures(1, &depth);
    framebuffer = colour = depth = 0;
}

/// Returns the framebuffer to read a picture from; 0: the window's own, where there is none.
GLuint Window::State::framebuffer_of(GLuint picture) {
    if (picture == 0) return framebuffer;
    if (shown == 0) glCreateFramebuffers(1, &shown);
    glNamedFramebufferTexture(shown, GL_COLOR_ATTACHMENT0, picture, 0);
    return shown;
}

namespace {

/// Divides the light of premultiplied sRGB colours by their alpha; without alpha they become black.
void divide_by_alpha(std::span<std::uint8_t> rgba) {
    constexpr double kMost = 255.0;
    for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
        const double alpha = rgba[i + 3] / kMost;
        if (rgba[i + 3] == 255) continue;
        for (std::size_t c = i; c < i + 3; ++c) {
            const double light = alpha > 0.0 ? std::min(image::light_of_srgb(rgba[c] / kMost) / alpha, 1.0) : 0.0;
            rgba[c] = static_cast<std::uint8_t>(std::lround(kMost * image::srgb_of_light(light)));
        }
    }
}

}  // namespace

Result<bool> write_screenshot(unsigned colour_texture, const std::string& file, PictureAlpha alpha) {
    GLint width = 0, height = 0;
    glGetTextureLevelParameteriv(colour_texture, 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(colour_texture, 0, GL_TEXTURE_HEIGHT, &height);
    const auto rows = static_cast<std::size_t>(height), row = static_cast<std::size_t>(width) * 4;
    std::vector<std::uint8_t> rgba(row * rows), flipped(rgba.size());
    glGetTextureImage(colour_texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(rgba.size()), rgba.data());
    for (std::size_t y = 0; y < rows; ++y)
        std::copy_n(rgba.data() + y * row, row, flipped.data() + (rows - 1 - y) * row);
    if (alpha == PictureAlpha::premultiplied) divide_by_alpha(flipped);
    for (std::size_t i = 3; alpha == PictureAlpha::opaque && i < flipped.size(); i += 4) flipped[i] = 255;
    const std::vector<std::uint8_t> png =
        encode_png(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), flipped);
    std::FILE* to = std::fopen(file.c_str(), "wb");
    const bool written = to != nullptr && std::fwrite(png.data(), 1, png.size(), to) == png.size();
    const bool closed = to == nullptr || std::fclose(to) == 0;
    if (!written || !closed) return Error{"cannot write the screenshot", file, {}, "output.write"};
    return true;
}

Result<std::unique_ptr<Window>> Window::open(const WindowOptions& options) {
    auto state = std::make_unique<State>();
    state->options = options;
    if (options.headless) {
        state->options.frames = std::max(options.frames, 1u);
        auto context = platform::make_headless_context(false);
        if (!context) return context.error();
        state->context = std::move(context).value();
    } else {
        auto window = platform::make_window(options.size_px.x, options.size_px.y, options.title, false);
        if (!window) return window.error();
        state->window = window.value().get();
        state->context = std::move(window).value();
    }
    if (!state->make_picture(options.size_px))
        return Error{"the device has no room for a picture of this size", {}, {}, "window.picture"};
    return std::unique_ptr<Window>(new Window(std::move(state)));
}

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::~Window() {
    state_->release_picture();
    glDeleteFramebuffers(1, &state_->shown);
}

bool Window::begin_frame() {
    State& s = *state_;
    if (s.closed || s.is_last()) return false;
    if (s.frames == 0) s.start = std::chrono::steady_clock::now();
    if (s.window) {
        const Input& input = s.window->poll();
        if (input.close_requested && s.frames > 0) return false;
        const glm::uvec2 size(input.framebuffer_width, input.framebuffer_height);
        if (size.x > 0 && size.y > 0 && !s.make_picture(size)) return false;  // 0: minimised
    }
    ++s.frames;
    if (!s.options.own_picture) return true;
    glBindFramebuffer(GL_FRAMEBUFFER, s.framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(s.size_px.x), static_cast<GLsizei>(s.size_px.y));
    return true;
}

Result<bool> Window::end_frame(unsigned picture) {
    State& s = *state_;
    const auto width = static_cast<GLint>(s.size_px.x), height = static_cast<GLint>(s.size_px.y);
    if (s.window) {
        const GLuint from = s.framebuffer_of(picture);
        const GLboolean cuts = glIsEnabled(GL_SCISSOR_TEST), encodes = glIsEnabled(GL_FRAMEBUFFER_SRGB);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_FRAMEBUFFER_SRGB);  // colours are encoded already
        if (from != 0)
            glBlitNamedFramebuffer(from, 0, 0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        if (cuts == GL_TRUE) glEnable(GL_SCISSOR_TEST);
        if (encodes == GL_TRUE) glEnable(GL_FRAMEBUFFER_SRGB);
        s.window->present();
    }
    if (!s.is_last() || s.options.screenshot.empty()) return true;
    return write_screenshot(picture != 0 ? picture : s.colour, s.options.screenshot);
}

const Input& Window::input() const { return state_->window ? state_->window->input() : state_->no_input; }
void Window::capture_mouse(bool on) {
    if (state_->window) state_->window->capture_mouse(on);
}
void Window::set_title(std::string_view title) {
    if (state_->window) state_->window->set_title(title);
}

glm::uvec2 Window::size_px() const { return state_->size_px; }
unsigned Window::framebuffer() const { return state_->framebuffer; }
unsigned Window::colour_texture() const { return state_->colour; }
unsigned Window::depth_texture() const { return state_->depth; }

double Window::time_s() const {
    constexpr double kFrame_s = 1.0 / 60.0;
    if (state_->options.frames > 0) return (state_->frames - 1.0) * kFrame_s;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - state_->start).count();
}

}  // namespace gnomon
