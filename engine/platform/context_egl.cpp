#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "engine/platform/context.h"

namespace gnomon::platform {

namespace {

constexpr EGLint kMaxDevices = 32;

bool has_word(const char* words, std::string_view word) {
    for (std::string_view rest = words == nullptr ? "" : words; !rest.empty();) {
        const std::size_t end = rest.find(' ');
        if (rest.substr(0, end) == word) return true;
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    return false;
}

template <class Function>
Function function_named(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

bool software_wanted() {
    const char* value = std::getenv("LIBGL_ALWAYS_SOFTWARE");
    return value != nullptr && (std::strcmp(value, "1") == 0 || std::strcmp(value, "true") == 0);
}

/// Adds the displays of hardware devices. They go first: beside a vendor driver, Mesa's surfaceless platform would
/// render on the processor although there is a GPU.
void add_hardware_displays(const char* client_extensions, std::vector<EGLDisplay>& displays) {
    if (software_wanted() || !has_word(client_extensions, "EGL_EXT_platform_device")) return;
    const auto query_devices = function_named<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto query_string = function_named<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (query_devices == nullptr || query_string == nullptr) return;
    std::array<EGLDeviceEXT, kMaxDevices> devices{};
    EGLint count = 0;
    if (query_devices(kMaxDevices, devices.data(), &count) != EGL_TRUE) return;
    for (EGLint i = 0; i < count; ++i) {
        EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
        if (has_word(query_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) continue;
        displays.push_back(eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
}

/// Returns displays to try, best first.
std::vector<EGLDisplay> candidate_displays() {
    const char* client_extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<EGLDisplay> displays;
    add_hardware_displays(client_extensions, displays);
    if (has_word(client_extensions, "EGL_MESA_platform_surfaceless")) {
        displays.push_back(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
    }
    displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return displays;
}

EGLContext create_context(EGLDisplay display, EGLConfig config, bool debug, bool robust) {
    std::vector<EGLint> attributes = {EGL_CONTEXT_MAJOR_VERSION,       4,
                                      EGL_CONTEXT_MINOR_VERSION,       5,
                                      EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                      EGL_CONTEXT_OPENGL_DEBUG,        debug ? EGL_TRUE : EGL_FALSE};
    if (robust) {
        attributes.insert(attributes.end(),
                          {EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE, EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                           EGL_LOSE_CONTEXT_ON_RESET});
    }
    attributes.push_back(EGL_NONE);
    return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

/// Context with its surface. The display stays initialised for the life of the process. There is one per driver, and
/// terminating it would end every other context on it.
class EglContext final : public Context {
public:
    EglContext(EGLDisplay display, EGLContext context, EGLSurface surface)
        : display_(display), context_(context), surface_(surface) {}
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext() override {
        if (eglGetCurrentContext() == context_) {  // another context may have become current since
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
        if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
        eglDestroyContext(display_, context_);
    }

private:
    EGLDisplay display_;
    EGLContext context_;
    EGLSurface surface_;
};

/// Creates a context on this display. Returns nullptr if that fails.
std::unique_ptr<Context> context_on(EGLDisplay display, bool debug) {
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    const std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                          EGL_NONE};
    const bool surfaceless = has_word(extensions, "EGL_KHR_surfaceless_context");
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint count = 0;
    if (!surfaceless || !has_word(extensions, "EGL_KHR_no_config_context")) {
        if (eglChooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0) return nullptr;
    }
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return nullptr;
    EGLContext context = create_context(display, config, debug, true);
    if (context == EGL_NO_CONTEXT) context = create_context(display, config, debug, false);
    if (context == EGL_NO_CONTEXT) return nullptr;
    EGLSurface surface = EGL_NO_SURFACE;
    if (!surfaceless) {
        const std::array<EGLint, 5> one_pixel = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        surface = eglCreatePbufferSurface(display, config, one_pixel.data());
    }
    if (eglMakeCurrent(display, surface, surface, context) != EGL_TRUE) {
        if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
        eglDestroyContext(display, context);
        return nullptr;
    }
    return std::make_unique<EglContext>(display, context, surface);
}

}  // namespace

Result<std::unique_ptr<Context>> make_headless_context(bool debug) {
    bool any_display = false;
    for (EGLDisplay display : candidate_displays()) {
        if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) continue;
        any_display = true;
        if (auto context = context_on(display, debug)) return context;
    }
    if (!any_display) return Error{"no EGL display can be opened without a window system", {}, {}, "egl.display"};
    return Error{"no EGL display offers an OpenGL 4.5 core context (docs/reference/limits.md)", {}, {}, "egl.context"};
}

}  // namespace gnomon::platform
