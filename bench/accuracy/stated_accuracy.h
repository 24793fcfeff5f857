#pragma once
#include <string>

#include "bench/accuracy/accuracy.h"

/// Compares a light's stated accuracy with the truth: how far edges of resolved casters are off, and
/// how wide those must be.
namespace gnomon::bench {

/// Displacement below which a picture of pixels does not distinguish bounds, pixels.
inline constexpr double kLeastTold_px = 0.25;

/// Returns true if neither figure is broken. At most a thousandth of the resolved places, rounded up, is farther off
/// than stated. No scored pixel needs a wider caster than stated. True where nothing is counted.
bool is_as_stated(const LightAccuracy& light);

/// Returns whether a broken figure fails the bench: that of a filter that walks triangles or traces rays. Filters that
/// read texels may lose an edge where a caster meets its receiver: of theirs the table alone reports it.
bool fails_bench(const LightAccuracy& light);

/// Returns the stated error over the measured 99th percentile, which counts as at least kLeastTold_px. A large ratio:
/// the bound is idle.
double slack_of(const LightAccuracy& light);

/// Describes what is broken in one line. Empty: nothing.
std::string broken_words(const LightAccuracy& light);

}  // namespace gnomon::bench
