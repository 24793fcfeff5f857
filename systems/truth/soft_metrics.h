#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

/// Distance of a picture of visibility from the truth about a source with a size.
namespace gnomon::truth {

/// Over scored pixels. A measured value that is none (no surface, not a number) counts as wrong by 1.
struct SoftMetrics {
    std::size_t scored = 0;
    std::size_t false_shadow = 0, false_light = 0;  // pixels that are too dark, too bright, by more than a half
    double mean_error = 0.0;                        // mean of |measured - truth|
    std::size_t umbra = 0, lit = 0;                 // pixels that see none of the source, all of it
    double umbra_leak = 0.0, lit_loss = 0.0;        // mean light there that should not be, mean light that is missing
    std::size_t penumbra = 0;                       // pixels between
    double penumbra_error = 0.0;                    // mean error there
};

/// Compares pictures of equal size, as in --visibility. `truth`: share of the source that is seen. `scored`: flags.
SoftMetrics compare_soft(std::span<const float> measured, std::span<const float> truth,
                         std::span<const std::uint8_t> scored);

}  // namespace gnomon::truth
