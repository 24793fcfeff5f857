#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "systems/debug/debug_view.h"

namespace gnomon::debug {

inline constexpr std::uint32_t kScaleColours = 8;

/// Matches ShownScale in shaders/debug/lookup.glsl (std140).
struct ShownScale {
    glm::vec4 colours[kScaleColours]{};  // rgb: linear; w: the length it stands for, metres
    glm::ivec4 options{-1, 0, 0, 0};     // x: the only map to be shown, below 0: all; y: colours that stand for lengths
};
static_assert(sizeof(ShownScale) == 16 * (kScaleColours + 1));
static_assert(kScaleColours >= shadow::kMaxViews);

/// The colour `srgb` as shaders want it.
glm::vec4 scale_colour(const glm::vec3& srgb, float value);

/// A drawing that looks `light` up at every surface, in these colours.
Drawing lookup_drawing(std::uint32_t light, const ShownScale& scale);

}  // namespace gnomon::debug
