#include "systems/debug/shown_scale.h"

#include <cmath>
#include <cstring>

namespace gnomon::debug {

glm::vec4 scale_colour(const glm::vec3& srgb, float value) {
    // IEC 61966-2-1.
    const auto linear = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
    return {linear(srgb.r), linear(srgb.g), linear(srgb.b), value};
}

Drawing lookup_drawing(std::uint32_t light, const ShownScale& scale) {
    Drawing drawing;
    drawing.light = light;
    drawing.block.resize(sizeof scale);
    std::memcpy(drawing.block.data(), &scale, sizeof scale);
    return drawing;
}

}  // namespace gnomon::debug
