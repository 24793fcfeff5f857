#include "systems/debug/shown_scale.h"

#include <cstring>

#include "engine/image/srgb.h"

namespace gnomon::debug {

glm::vec4 scale_colour(const glm::vec3& srgb, float value) {
    return {image::light_of_srgb(srgb.r), image::light_of_srgb(srgb.g), image::light_of_srgb(srgb.b), value};
}

Drawing lookup_drawing(std::uint32_t light, const ShownScale& scale) {
    Drawing drawing;
    drawing.light = light;
    drawing.block.resize(sizeof scale);
    std::memcpy(drawing.block.data(), &scale, sizeof scale);
    return drawing;
}

}  // namespace gnomon::debug
