#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "gnomon/result.h"

/// OpenGL 4.5 core context with a picture to draw into, in a window or without one. For examples, tools and tests; an
/// engine brings its own.
namespace gnomon {

/// What a window, or a picture without one, is like.
struct WindowOptions {
    std::string title = "Gnomon";   // shown in its frame
    glm::uvec2 size_px{1280, 720};  // picture's size, each above 0
    bool headless = false;          // no window: EGL, for machines without a display
    std::uint32_t frames = 0;     // number of frames until begin_frame() returns false; 0: until the window is closed.
                                  // Headless: at least 1
    std::string screenshot = {};  // PNG of the last frame; empty: none
};

/// Reads --headless, --size WxH, --frames N and --screenshot F.png. Error ("usage"): anything else, --help included;
/// its message is the usage.
Result<WindowOptions> window_options(int argc, const char* const* argv, std::string_view title);

/// Writes a GL_TEXTURE_2D with channels of 8 bits as an opaque PNG. Row 0 is the lowest, as OpenGL draws. Colours are
/// written as they are stored. Error: "output.write".
Result<bool> write_screenshot(unsigned colour_texture, const std::string& file);

/// Window, or picture without one. The context is current on the creating thread until it is destroyed.
class Window {
public:
    /// Errors: "glfw.init", "glfw.window", "egl.display", "egl.context" (no display, or no OpenGL 4.5),
    /// "window.picture".
    static Result<std::unique_ptr<Window>> open(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Begins a frame: reads events, fits the picture to the window, binds framebuffer() and sets the viewport. Returns
    /// false when the window is closed or all frames are drawn.
    bool begin_frame();
    /// Shows the picture, and writes the screenshot in the last frame. Error: "output.write".
    Result<bool> end_frame();

    /// Returns the picture's size in this frame.
    glm::uvec2 size_px() const;
    double time_s() const;            // since the first frame; headless, or with a number of frames: 1/60 s per frame
    unsigned framebuffer() const;     // with both textures
    unsigned colour_texture() const;  // GL_SRGB8_ALPHA8: enable GL_FRAMEBUFFER_SRGB to have colours encoded
    unsigned depth_texture() const;   // GL_DEPTH_COMPONENT32F

private:
    struct State;
    explicit Window(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon
