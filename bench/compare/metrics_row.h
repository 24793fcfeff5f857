#pragma once
#include <optional>
#include <span>

#include "bench/common/median_range.h"

namespace gnomon::bench {

/// Empty: it was not measured, or cannot be of such a row.
using Figure = std::optional<double>;

/// Figures of one row for one light: errors of its shadows, and their cost. Shares are 0 to 1.
struct RowFigures {
    Figure taps, views, texels, bytes, draws;
    /// Against the truth about a point, of scored pixels; none of filters that soften by the source's size.
    Figure scored_px, other_surface_px, wrong, false_shadow, false_light, acne, leak, mean_error;
    Figure edge_places, edge_lost, edge_p50_px, edge_p95_px, edge_p99_px, edge_max_px;
    /// Shares of false shadow and false light that neither an edge nor the map's texels there explain
    /// (oracle::FarErrors).
    Figure false_shadow_far, false_light_far;
    /// Error that the fit states, and numbers of places farther off than is predicted there, by reason.
    Figure predicted_px, sub_texel_caster, truth_ambiguous, other_bias, unexplained;
    /// Against the truth about disk_source().
    Figure disk_error, umbra_leak, lit_loss, penumbra_error, width_ratio;
    /// Against the lit share of pixels' areas, in pixels that an edge crosses; none of filters by the source's size.
    Figure area_error, area_bias, area_p99;
    /// Times of the depth and lighting pass: gpu with every view drawn in every frame, kept with kept maps. A median
    /// per round. Ratios are to the base row of the same round.
    Spread gpu_us, gpu_ratio, kept_us, kept_ratio;
    Spread cpu_us;  // time of the shadow stages, every view drawn
};

/// A figure by name, for files and tables.
struct FigureColumn {
    const char* name;     // as in JSON and CSV
    const char* meaning;  // one line
    Figure (*get)(const RowFigures& figures);
    void (*set)(RowFigures& figures, double value);
};
std::span<const FigureColumn> figure_columns();

}  // namespace gnomon::bench
