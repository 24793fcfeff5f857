#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>

#include "engine/platform/context.h"

namespace gnomon::platform {

namespace {

constexpr std::uint32_t kMaxWindowPx = 16384;

struct KeyName {
    int glfw;
    Key key;
};
constexpr std::array kKeys = {KeyName{GLFW_KEY_W, Key::w},
                              KeyName{GLFW_KEY_A, Key::a},
                              KeyName{GLFW_KEY_S, Key::s},
                              KeyName{GLFW_KEY_D, Key::d},
                              KeyName{GLFW_KEY_Q, Key::q},
                              KeyName{GLFW_KEY_E, Key::e},
                              KeyName{GLFW_KEY_SPACE, Key::space},
                              KeyName{GLFW_KEY_LEFT_SHIFT, Key::shift},
                              KeyName{GLFW_KEY_RIGHT_SHIFT, Key::shift},
                              KeyName{GLFW_KEY_ESCAPE, Key::escape},
                              KeyName{GLFW_KEY_P, Key::p},
                              KeyName{GLFW_KEY_R, Key::r},
                              KeyName{GLFW_KEY_T, Key::t},
                              KeyName{GLFW_KEY_F1, Key::f1},
                              KeyName{GLFW_KEY_F2, Key::f2},
                              KeyName{GLFW_KEY_F3, Key::f3},
                              KeyName{GLFW_KEY_F4, Key::f4},
                              KeyName{GLFW_KEY_F5, Key::f5},
                              KeyName{GLFW_KEY_F6, Key::f6},
                              KeyName{GLFW_KEY_F7, Key::f7},
                              KeyName{GLFW_KEY_F8, Key::f8},
                              KeyName{GLFW_KEY_F9, Key::f9},
                              KeyName{GLFW_KEY_F10, Key::f10},
                              KeyName{GLFW_KEY_F11, Key::f11},
                              KeyName{GLFW_KEY_F12, Key::f12},
                              KeyName{GLFW_KEY_LEFT, Key::left},
                              KeyName{GLFW_KEY_RIGHT, Key::right},
                              KeyName{GLFW_KEY_UP, Key::up},
                              KeyName{GLFW_KEY_DOWN, Key::down},
                              KeyName{GLFW_KEY_TAB, Key::tab},
                              KeyName{GLFW_KEY_ENTER, Key::enter},
                              KeyName{GLFW_KEY_KP_ENTER, Key::enter},
                              KeyName{GLFW_KEY_BACKSPACE, Key::backspace}};

struct PadButtonName {
    int glfw;
    PadButton button;
};
constexpr std::array kPadButtons = {PadButtonName{GLFW_GAMEPAD_BUTTON_A, PadButton::a},
                                    PadButtonName{GLFW_GAMEPAD_BUTTON_B, PadButton::b},
                                    PadButtonName{GLFW_GAMEPAD_BUTTON_X, PadButton::x},
                                    PadButtonName{GLFW_GAMEPAD_BUTTON_Y, PadButton::y},
                                    PadButtonName{GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, PadButton::left_bumper},
                                    PadButtonName{GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, PadButton::right_bumper},
                                    PadButtonName{GLFW_GAMEPAD_BUTTON_BACK, PadButton::back},
                                    PadButtonName{GLFW_GAMEPAD_BUTTON_START, PadButton::start},
                                    PadButtonName{GLFW_GAMEPAD_BUTTON_DPAD_LEFT, PadButton::left},
                                    PadButtonName{GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, PadButton::right}};
static_assert(kMaxGamepads == GLFW_JOYSTICK_LAST + 1);

/// Reads the gamepad in a slot. `present` is false if the slot is empty or GLFW has no layout for the device.
Gamepad read_gamepad(int slot) {
    Gamepad pad;
    GLFWgamepadstate state;
    if (glfwGetGamepadState(slot, &state) != GLFW_TRUE) return pad;
    pad.present = true;
    pad.left_x = state.axes[GLFW_GAMEPAD_AXIS_LEFT_X];
    pad.left_y = state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y];
    pad.right_x = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X];
    pad.right_y = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y];
    pad.left_trigger = state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER];
    pad.right_trigger = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER];
    for (const PadButtonName& name : kPadButtons)
        pad.down[static_cast<std::size_t>(name.button)] = state.buttons[name.glfw] == GLFW_PRESS;
    return pad;
}

/// Describes the last failed GLFW call on one line.
Error glfw_error(std::string what, std::string rule) {
    const char* description = nullptr;
    if (glfwGetError(&description) != GLFW_NO_ERROR && description != nullptr) what += std::string{": "} + description;
    std::replace(what.begin(), what.end(), '\n', ' ');
    return {std::move(what), {}, {}, std::move(rule)};
}

class GlfwWindow final : public Window {
public:
    explicit GlfwWindow(GLFWwindow* window) : window_(window) {
        glfwSetWindowUserPointer(window, this);
        glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) { self(w).on_key(key, action); });
        glfwSetCharCallback(window, [](GLFWwindow* w, unsigned int codepoint) { self(w).on_character(codepoint); });
        glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { self(w).on_cursor(x, y); });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int action, int) { self(w).on_button(action); });
        glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) { self(w).on_focus(focused); });
        glfwGetCursorPos(window, &input_.mouse_x, &input_.mouse_y);
        read_size();
    }
    GlfwWindow(const GlfwWindow&) = delete;
    GlfwWindow& operator=(const GlfwWindow&) = delete;
    ~GlfwWindow() override {
        glfwDestroyWindow(window_);
        glfwTerminate();
    }

    const Input& poll() override {
        std::fill(std::begin(input_.pressed), std::end(input_.pressed), false);
        input_.mouse_dx = input_.mouse_dy = 0.0;
        input_.mouse_pressed = false;
        input_.typed_count = 0;
        glfwPollEvents();
        for (std::size_t slot = 0; slot < kMaxGamepads; ++slot)
            input_.gamepads[slot] = read_gamepad(static_cast<int>(slot));
        input_.close_requested = glfwWindowShouldClose(window_) == GLFW_TRUE;
        read_size();
        return input_;
    }
    const Input& input() const override { return input_; }
    void present() override { glfwSwapBuffers(window_); }
    void capture_mouse(bool on) override {
        glfwSetInputMode(window_, GLFW_CURSOR, on ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
        if (glfwRawMouseMotionSupported() == GLFW_TRUE) glfwSetInputMode(window_, GLFW_RAW_MOUSE_MOTION, on);
        // The cursor jumps when its mode changes, which is no movement of the mouse.
        glfwGetCursorPos(window_, &input_.mouse_x, &input_.mouse_y);
    }
    void set_title(std::string_view title) override { glfwSetWindowTitle(window_, std::string{title}.c_str()); }
    void* native_handle() override { return window_; }

private:
    static GlfwWindow& self(GLFWwindow* window) { return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window)); }
    void read_size() {
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        input_.framebuffer_width = static_cast<std::uint32_t>(std::max(width, 0));
        input_.framebuffer_height = static_cast<std::uint32_t>(std::max(height, 0));
    }
    void on_key(int glfw_key, int action) {
        const auto at = std::find_if(kKeys.begin(), kKeys.end(), [&](const KeyName& k) { return k.glfw == glfw_key; });
        if (at == kKeys.end() || action == GLFW_REPEAT) return;
        const auto key = static_cast<std::size_t>(at->key);
        input_.down[key] = action == GLFW_PRESS;
        if (action == GLFW_PRESS) input_.pressed[key] = true;  // stays true even if released before the poll ends
    }
    void on_character(char32_t character) {
        if (input_.typed_count < kMaxTyped) input_.typed[input_.typed_count++] = character;
    }
    void on_cursor(double x, double y) {
        input_.mouse_dx += x - input_.mouse_x;
        input_.mouse_dy += y - input_.mouse_y;
        input_.mouse_x = x;
        input_.mouse_y = y;
    }
    void on_button(int action) {
        buttons_down_ = std::max(buttons_down_ + (action == GLFW_PRESS ? 1 : -1), 0);
        input_.mouse_button = buttons_down_ > 0;
        if (action == GLFW_PRESS) input_.mouse_pressed = true;
    }
    void on_focus(int focused) {
        if (focused == GLFW_TRUE) return;
        std::fill(std::begin(input_.down), std::end(input_.down), false);
        buttons_down_ = 0;
        input_.mouse_button = false;
    }

    GLFWwindow* window_;
    Input input_;
    int buttons_down_ = 0;
};

GLFWwindow* create_window(std::uint32_t width, std::uint32_t height, const std::string& title, bool debug, int robust) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, robust);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // no depth: scenes are drawn into textures, the window only shows them
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    return glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(), nullptr, nullptr);
}

/// Hints against Wayland if the environment names no Wayland socket. GLFW 3.4 would try it last, and its client library
/// prints an error line then.
void choose_window_system() {
#ifdef GLFW_PLATFORM
    constexpr std::array kWaylandNames{"WAYLAND_DISPLAY", "WAYLAND_SOCKET", "XDG_RUNTIME_DIR"};
    const bool has_wayland = std::any_of(kWaylandNames.begin(), kWaylandNames.end(),
                                         [](const char* name) { return std::getenv(name) != nullptr; });
    glfwInitHint(GLFW_PLATFORM, has_wayland ? GLFW_ANY_PLATFORM : GLFW_PLATFORM_X11);
#endif
}

}  // namespace

Result<std::unique_ptr<Window>> make_window(std::uint32_t width, std::uint32_t height, std::string_view title,
                                            bool debug) {
    if (width == 0 || height == 0 || width > kMaxWindowPx || height > kMaxWindowPx) {
        return Error{"a window must have 1 to 16384 pixels on each side", {}, {}, "glfw.window"};
    }
    choose_window_system();
    if (glfwInit() != GLFW_TRUE) return glfw_error("no window system", "glfw.init");
    const std::string name{title};
    GLFWwindow* window = create_window(width, height, name, debug, GLFW_LOSE_CONTEXT_ON_RESET);
    if (window == nullptr) window = create_window(width, height, name, debug, GLFW_NO_ROBUSTNESS);
    if (window == nullptr) {
        Error error = glfw_error("no window with an OpenGL 4.5 core context (docs/reference/limits.md)", "glfw.window");
        glfwTerminate();
        return error;
    }
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
    return std::unique_ptr<Window>{std::make_unique<GlfwWindow>(window)};
}

}  // namespace gnomon::platform
