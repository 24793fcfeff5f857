#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "bench/common/configuration.h"

namespace gnomon::bench {

enum class SweepSize : std::uint8_t { quick, full };

/// The row that nothing is set for: all others are compared with it.
inline constexpr std::string_view kDefaultsRow = "defaults";
/// Rows of what a tutorial gives, by the start of their name.
inline constexpr std::string_view kTutorialFactor = "tutorial";

struct SweepRow : RowSetup {
    std::string factor;  // what is varied: kDefaultsRow, "filter", "resolution x bias", kTutorialFactor ...
};

/// Most rows of a sweep: beyond it neither a comparison nor its time is practical.
inline constexpr std::size_t kMostSweepRows = 400;

/// Returns the rows of a sweep for lights of these kinds, each with the settings of its kind. No two rows have the same
/// settings for a kind of light; the first is kDefaultsRow. Pure function. Rows:
/// - the defaults;
/// - one factor at a time around them: fit, cascades, resolution, format, filter, bias;
/// - resolution against filter, bias and cascades;
/// - settings of tutorials.
std::vector<SweepRow> sweep_plan(SweepSize size, LightKinds kinds = kAllKinds);

}  // namespace gnomon::bench
