#include <charconv>
#include <optional>

#include "gnomon/window.h"

namespace gnomon {
namespace {

std::optional<std::uint32_t> number_of(std::string_view text) {
    std::uint32_t value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = read.ec == std::errc() && read.ptr == text.data() + text.size();
    return whole ? std::optional(value) : std::nullopt;
}

/// Reads "640x480". Neither side may be 0.
std::optional<glm::uvec2> size_of(std::string_view text) {
    const std::size_t cross = text.find('x');
    if (cross == std::string_view::npos) return std::nullopt;
    const auto width = number_of(text.substr(0, cross)), height = number_of(text.substr(cross + 1));
    constexpr std::uint32_t kMost_px = 16384;  // what devices of OpenGL 4.5 must allow
    const bool usable = width && height && *width > 0 && *height > 0 && *width <= kMost_px && *height <= kMost_px;
    return usable ? std::optional(glm::uvec2(*width, *height)) : std::nullopt;
}

}  // namespace

Result<WindowOptions> window_options(int argc, const char* const* argv, std::string_view title) {
    WindowOptions options;
    options.title = title;
    const Error usage{"usage: " + std::string(title) + " [--headless] [--size WxH] [--frames N] [--screenshot F.png]",
                      {},
                      {},
                      "usage"};
    for (int i = 1; i < argc; ++i) {
        const std::string_view flag = argv[i];
        if (flag == "--headless") {
            options.headless = true;
            continue;
        }
        if (i + 1 == argc) return usage;
        const std::string_view value = argv[++i];
        if (flag == "--screenshot") {
            options.screenshot = value;
        } else if (flag == "--frames") {
            const auto frames = number_of(value);
            if (!frames) return usage;
            options.frames = *frames;
        } else if (flag == "--size") {
            const auto size = size_of(value);
            if (!size) return usage;
            options.size_px = *size;
        } else {
            return usage;
        }
    }
    return options;
}

}  // namespace gnomon
