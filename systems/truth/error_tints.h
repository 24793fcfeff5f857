#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "systems/truth/light_truth.h"

/// Errors as a layer over the picture that they are errors of.
namespace gnomon::truth {

/// One light's visibility as it was drawn, of every pixel, beside its truth.
struct DrawnLight {
    std::span<const float> measured;
    const LightTruth* truth = nullptr;
};

/// What lies over wrong pixels' neighbours, so that one alone is seen; and over all that is right.
inline constexpr int kHalo_px = 2;

/// Fills `rgba` with 8 bit sRGB and coverage, bottom row first. Each pixel has the colour (error_colour()) of the light
/// that is farthest off there: wrong ones are opaque, with a halo; others have as much of it as they are off, 0 to a
/// half. Ambiguous pixels are faint white. What is right, or not scored, is darkened a little.
void tint_errors(glm::uvec2 size_px, std::span<const DrawnLight> lights, std::vector<std::uint8_t>& rgba);

}  // namespace gnomon::truth
