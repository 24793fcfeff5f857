#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/accuracy/reference_images.h"
#include "bench/check/check_progress.h"
#include "bench/common/configuration.h"
#include "bench/common/median_range.h"
#include "bench/common/stage.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::bench {

/// One kind × filter, and of a point light × the way its faces are drawn.
struct CheckRowSetup : RowSetup {
    LightKind kind = LightKind::point;
    const shadow::FilterRow* filter = nullptr;
    CubeRoute route = CubeRoute::automatic;  // point light: any other value
};

enum class CheckVerdict : std::uint8_t { ok, failed, not_judged };
const char* to_text(CheckVerdict verdict);

/// Differences of a row's picture from the truth. Counts are pixels. Pixels that
/// depend on the last digits are in none.
struct CheckErrors {
    std::size_t scored = 0;
    /// Pixels on the wrong side of a half. For filters that soften by the source's
    /// size only pixels that see all or nothing of it count.
    std::size_t wrong = 0;
    std::size_t acne = 0, leak = 0;  // wrong, over oracle::kEdgeBandPx from true
                                     // edges: too dark, too bright
    std::size_t uncovered = 0;       // a surface, and no value there
    /// Farther from the truth than `tolerance` where neither an edge nor the
    /// map's texels explain it (oracle::FarErrors).
    std::size_t unexplained = 0;
    std::optional<double> penumbra_error;  // mean, of filters that soften by the source's size
};

struct CheckRow {
    CheckRowSetup setup;
    CheckVerdict verdict = CheckVerdict::not_judged;
    std::string why;  // reason of every verdict except ok
    double tolerance = 0.0;
    CheckErrors errors;
    std::uint32_t map_px = 0;
    double bytes = 0.0;
    Spread drawn_us, kept_us;  // depth and lighting pass, every view drawn and
                               // with kept maps; count 0: not measured
};

struct RowChecks {
    glm::uvec2 size_px{0, 0};
    double trace_s = 0.0, took_s = 0.0;
    std::size_t left_out = 0;  // by the selection
    std::string error;         // why there are no rows; empty: there are
    std::vector<CheckRow> rows;
};

struct RowCheckOptions {
    std::vector<std::string> settings;  // on top of every row's
    std::uint32_t frames = 5;
};

/// Returns every row: by kind, then filter, then route.
std::vector<CheckRowSetup> check_row_setups();

/// Traces the truths that these rows are compared with; those of sources with a
/// size only where a filter softens by it. Errors: those of trace_truths().
Result<TracedTruths> trace_check_truths(Stage& stage, std::span<const CheckRowSetup> rows);

/// Draws, judges and times one row.
CheckRow check_row(Stage& stage, const TracedTruths& truths, const CheckRowSetup& setup,
                   const RowCheckOptions& options);

}  // namespace gnomon::bench
