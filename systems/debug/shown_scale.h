#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "systems/debug/debug_view.h"

namespace gnomon::debug {

inline constexpr std::uint32_t kScaleColours = 8;

/// Matches ShownScale in shaders/debug/lookup.glsl (std140).
struct ShownScale {
    glm::vec4 colours[kScaleColours]{};  // rgb: linear; w: the value it stands for
};
static_assert(sizeof(ShownScale) == std::size_t{16} * kScaleColours);
static_assert(kScaleColours >= shadow::kMaxViews);

/// The colour `srgb` as shaders want it.
glm::vec4 scale_colour(const glm::vec3& srgb, float value);

/// A drawing that looks `light` up at every surface, in these colours.
Drawing lookup_drawing(std::uint32_t light, const ShownScale& scale);

}  // namespace gnomon::debug
