#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "systems/truth/light_truth.h"

/// Errors as a layer over their picture.
namespace gnomon::truth {

/// Drawn visibility of a light, per pixel, and its truth.
struct DrawnLight {
    std::span<const float> measured;
    const LightTruth* truth = nullptr;
    std::span<const float> tint_off = {};  // compare_tint(); empty: its colours are not judged
};

/// Radius of the halo around wrong pixels, which makes single ones visible.
inline constexpr int kHalo_px = 2;

/// Fills `rgba` with 8 bit sRGB and coverage, bottom row first. Each pixel has the colour (error_colour()) of the light
/// with the largest error, of visibility or of a channel of its colour. Wrong pixels, off by more than a half, are
/// opaque with a halo; other errors have a coverage equal to the error, 0 to 1/2. Ambiguous pixels are faint white.
/// Correct or unscored pixels are slightly darkened.
void tint_errors(glm::uvec2 size_px, std::span<const DrawnLight> lights, std::vector<std::uint8_t>& rgba);

}  // namespace gnomon::truth
