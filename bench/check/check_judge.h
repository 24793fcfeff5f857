#pragma once
#include <string>
#include <vector>

#include "bench/check/check_rows.h"

namespace gnomon::bench {

/// Returns how far a value may be from the truth where no edge is near.
/// docs/reference/check.md derives the tolerances. Depending on the filter it is
/// - a step of eight bits, which samplers weigh by;
/// - the share of one ray of exact_soft;
/// - a half for filters that estimate.
double row_tolerance(const shadow::FilterRow& filter, std::uint32_t rays);

/// Judges a light in the frame that the stage has just drawn.
CheckErrors judge_check_row(Stage& stage, const TracedTruths& truths, const TracedLight& light,
                            const std::vector<float>& measured, const shadow::FilterRow& filter, double tolerance);

/// Returns why the row may not have these errors; empty: it may.
std::string broken_bound(const shadow::FilterRow& filter, std::uint32_t rays, const CheckErrors& errors);

}  // namespace gnomon::bench
