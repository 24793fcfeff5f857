#include "bench/common/parse_arguments.h"

#include "sample_game/support/settings/parse_number.h"

namespace gnomon::bench {

std::optional<glm::uvec2> parse_size(const std::string& text) {
    constexpr std::uint64_t kMaxSizePx = 16384;
    const auto cross = text.find('x');
    if (cross == std::string::npos) return std::nullopt;
    const auto width = game::read_count(text.substr(0, cross)), height = game::read_count(text.substr(cross + 1));
    if (!width || !height || *width == 0 || *height == 0 || *width > kMaxSizePx || *height > kMaxSizePx)
        return std::nullopt;
    return glm::uvec2(*width, *height);
}

std::optional<glm::dvec3> parse_offset(const std::string& text) {
    glm::dvec3 value(0.0);
    if (text.empty()) return value;
    std::size_t start = 0;
    for (int i = 0; i < 3; ++i) {
        const std::size_t end = i < 2 ? text.find(',', start) : text.size();
        if (end == std::string::npos) return std::nullopt;
        const auto number = game::read_number(text.substr(start, end - start));
        if (!number) return std::nullopt;
        value[i] = *number;
        start = end + 1;
    }
    return value;
}

}  // namespace gnomon::bench
