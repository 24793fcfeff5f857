#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "bench/compare/filter_variants.h"
#include "bench/compare/metrics_row.h"
#include "gnomon/result.h"

namespace gnomon::bench {

/// Axes of a front: its error and its time.
enum class RowTruth : std::uint8_t { point, disk };
enum class RowCost : std::uint8_t { drawn, kept };
inline constexpr std::array<RowTruth, 2> kRowTruths = {RowTruth::point, RowTruth::disk};
inline constexpr std::array<RowCost, 2> kRowCosts = {RowCost::drawn, RowCost::kept};

struct FilterRows {
    std::string scene, device;
    glm::uvec2 size_px{0, 0};
    std::vector<FilterVariant> variants;
    std::vector<std::string> lights;
    std::vector<std::uint32_t> resolutions_px;  // 0: each row's own
    /// Figures by resolution, variant and light.
    std::vector<std::vector<std::vector<RowFigures>>> figures;

    /// Returns whether the truth judges that row. None does where the light's shadow is left out on purpose.
    bool is_judged(std::size_t resolution, std::size_t variant, std::size_t light, RowTruth truth) const {
        const RowFigures& row = figures[resolution][variant][light];
        return truth == RowTruth::point ? row.wrong.has_value() : row.disk_error.has_value();
    }
    /// Returns for each variant whether it is the best at some cost; 0 also if the truth does not judge it.
    std::vector<std::uint8_t> front(std::size_t resolution, std::size_t light, RowTruth truth, RowCost cost) const;
    /// Returns the names of rows without a variant on any front.
    std::vector<std::string> never_best() const;
};

struct FilterRowsOptions {
    std::string only;                      // rows with this part in their name, and `hard`; empty: all
    std::uint32_t rounds = 5, frames = 9;  // frames: timed of each kind per round; 0: no timing
};

/// Compares every row of the filter table with the truths that may judge it. Maps have each row's own size, and one
/// size for all: the largest power of two within the picture's larger side, so that texels show. Truth is traced once.
/// Errors: "bench.visibility", "bench.camera", "set.*".
Result<FilterRows> measure_filter_rows(Stage& stage, const FilterRowsOptions& options);

/// Returns a table for people, and the rows that are the best at some cost.
std::string filter_rows_table(const FilterRows& rows);
/// Returns the same in Markdown.
std::string filter_rows_markdown(const FilterRows& rows);
/// Returns all results for scripts: bench/README.md lists the keys.
std::string filter_rows_json(const FilterRows& rows);

}  // namespace gnomon::bench
