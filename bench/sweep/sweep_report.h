#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/sweep/analysis.h"

/// A sweep in files, for scripts, spreadsheets and people; bench/README.md lists keys and columns.
namespace gnomon::bench {

std::string sweep_json(const std::vector<SceneSweep>& scenes);
std::string sweep_csv(const std::vector<SceneSweep>& scenes);

/// Error against time of one light's rows, on logarithmic axes, as SVG. Empty if no row has both.
std::string front_plot(const SceneSweep& sweep, const std::string& light, SweepTruth truth, SweepCost cost);

/// One page that needs nothing else: findings, plots, a table to sort and to search, and pictures of each row. If those
/// are too large for kMostPictureBytes, rows on a front come first, and the page says so.
std::string sweep_page(const std::vector<SceneSweep>& scenes);
inline constexpr std::size_t kMostPictureBytes = 12'000'000;  // as text in the page

/// What halving the error costs, in a sentence per light.
std::vector<std::string> halving_sentences(const SceneSweep& sweep);

/// Tables of what was found, for docs/cost.md.
std::string sweep_markdown(const std::vector<SceneSweep>& scenes);
/// A few lines for a terminal.
std::string sweep_summary(const std::vector<SceneSweep>& scenes);

/// report.json, report.csv, report.html in `folder`. Errors: those of game::write_file.
std::optional<Error> write_sweep(const std::vector<SceneSweep>& scenes, const std::filesystem::path& folder);

}  // namespace gnomon::bench
