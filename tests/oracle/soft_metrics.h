#pragma once
#include <cstddef>
#include <span>

#include "systems/truth/soft_metrics.h"
#include "tests/oracle/soft_truth.h"

/// How far a picture of visibility is from the truth about a source with a size.
namespace gnomon::oracle {

/// Ratios of measured to true widths of penumbras, along rows and columns of the picture. A place is where the truth
/// rises from a tenth to nine tenths, or falls, on one plane. Hard edges have a ratio near 0.
struct PenumbraWidths {
    std::size_t places = 0;  // truly at least kLeastPenumbra_px wide
    std::size_t lost = 0;    // nothing measured there goes from a tenth to nine tenths: ratio 0
    double median_ratio = 0.0, p10_ratio = 0.0, p90_ratio = 0.0;  // 0 without places
};

struct SoftMetrics : truth::SoftMetrics {
    PenumbraWidths widths;
};

inline constexpr std::size_t kLeastPenumbra_px = 4;

/// Compares `measured`, values as --visibility writes them, of the size of the hits, with the truth.
SoftMetrics compare_soft(const PrimaryHits& hits, const SoftTruth& truth, std::span<const float> measured);

}  // namespace gnomon::oracle
