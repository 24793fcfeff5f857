#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "gnomon/result.h"
#include "gnomon/window.h"

namespace gnomon::platform {

/// OpenGL 4.5 core context, current on the creating thread until destroyed.
class Context {
public:
    virtual ~Context() = default;
};

/// Creates a context that needs no window system. Tries EGL on the first hardware device, then Mesa's surfaceless
/// platform, then the default display. LIBGL_ALWAYS_SOFTWARE=1 skips hardware. The context is robust
/// (LOSE_CONTEXT_ON_RESET) where the driver supports that. Errors: rules "egl.display", "egl.context".
Result<std::unique_ptr<Context>> make_headless_context(bool debug);

/// Window with its context; one at a time, created and used on the main thread. Errors: rules "glfw.init",
/// "glfw.window" (no display, no GL 4.5).
class Window : public Context {
public:
    virtual const Input& poll() = 0;         // processes events
    virtual const Input& input() const = 0;  // as the last poll() found it
    virtual void present() = 0;              // swaps
    virtual void capture_mouse(bool on) = 0;
    virtual void set_title(std::string_view title) = 0;
    virtual void* native_handle() = 0;  // GLFWwindow*
};
Result<std::unique_ptr<Window>> make_window(std::uint32_t width, std::uint32_t height, std::string_view title,
                                            bool debug);

}  // namespace gnomon::platform
