#pragma once
#include <string>
#include <vector>

#include "bench/check/check_rows.h"

namespace gnomon::bench {

/// How far a value may be from the truth where no edge is near: a step of eight
/// bits, which is what samplers weigh by; a ray of those that exact_soft asks;
/// a half of filters that estimate what they blur. docs/check.md derives them.
double row_tolerance(const shadow::FilterRow& filter, std::uint32_t rays);

/// Of a light in the frame that the stage has just drawn.
CheckErrors judge_check_row(Stage& stage, const TracedTruths& truths, const TracedLight& light,
                            const std::vector<float>& measured, const shadow::FilterRow& filter, double tolerance);

/// Why these errors are none that the row may have; empty: they may be.
std::string broken_bound(const shadow::FilterRow& filter, std::uint32_t rays, const CheckErrors& errors);

}  // namespace gnomon::bench
