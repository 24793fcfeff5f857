#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "systems/debug/debug_view.h"

namespace gnomon::debug {

inline constexpr std::uint32_t kScaleColours = 8;

/// Colour scale; matches ShownScale in shaders/debug/lookup.glsl (std140).
struct ShownScale {
    glm::vec4 colours[kScaleColours]{};  // rgb: linear; w: length of the colour, metres
    glm::ivec4 options{-1, 0, 0, 0};     // x: the only map to show, < 0: all; y: number of colours with a length
};
static_assert(sizeof(ShownScale) == 16 * (kScaleColours + 1));
static_assert(kScaleColours >= shadow::kMaxViews);

/// Converts an sRGB colour and its value for shaders.
glm::vec4 scale_colour(const glm::vec3& srgb, float value);

/// Makes a drawing that runs the lookups of `light` at every surface and shows them in these colours.
Drawing lookup_drawing(std::uint32_t light, const ShownScale& scale);

}  // namespace gnomon::debug
