#pragma once
#include <cstddef>
#include <span>

#include "tests/oracle/soft_truth.h"

/// How far a picture of visibility is from the truth about a source with a size.
namespace gnomon::oracle {

/// Along rows and columns of the picture, where the truth rises from a tenth to nine tenths, or falls, on one plane:
/// how wide that is as measured, of how wide it truly is. Hard edges have a ratio near 0.
struct PenumbraWidths {
    std::size_t places = 0;  // of at least kLeastPenumbra_px
    std::size_t lost = 0;    // nothing measured there goes from a tenth to nine tenths: ratio 0
    double median_ratio = 0.0, p10_ratio = 0.0, p90_ratio = 0.0;  // 0 without places
};

/// Over scored pixels. A measured value that is none (no surface, not a number) counts as wrong by 1.
struct SoftMetrics {
    std::size_t scored = 0;
    double mean_error = 0.0;                  // of |measured - truth|
    std::size_t umbra = 0, lit = 0;           // pixels that see none of the source, all of it
    double umbra_leak = 0.0, lit_loss = 0.0;  // mean light there that should not be, mean light that is missing
    std::size_t penumbra = 0;                 // pixels between
    double penumbra_error = 0.0;              // mean error there
    PenumbraWidths widths;
};

inline constexpr std::size_t kLeastPenumbra_px = 4;

/// `measured` as of --visibility, of the size of the hits.
SoftMetrics compare_soft(const PrimaryHits& hits, const SoftTruth& truth, std::span<const float> measured);

}  // namespace gnomon::oracle
