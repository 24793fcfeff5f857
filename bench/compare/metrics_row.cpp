#include "bench/compare/metrics_row.h"

#include <algorithm>

namespace gnomon::bench {
namespace {

template <Figure RowFigures::*figure>
constexpr FigureColumn of(const char* name, const char* meaning) {
    return {name, meaning, [](const RowFigures& figures) { return figures.*figure; },
            [](RowFigures& figures, double value) { figures.*figure = value; }};
}

template <Spread RowFigures::*spread, double Spread::*part>
constexpr FigureColumn of(const char* name, const char* meaning) {
    return {name, meaning,
            [](const RowFigures& figures) {
                const Spread& s = figures.*spread;
                return s.count == 0 ? Figure() : Figure(s.*part);
            },
            [](RowFigures& figures, double value) {
                (figures.*spread).*part = value;
                (figures.*spread).count = std::max<std::size_t>((figures.*spread).count, 1);
            }};
}

using F = RowFigures;
using S = Spread;

constexpr FigureColumn kColumns[] = {
    of<&F::taps>("taps", "texture fetches per lookup at most"),
    of<&F::views>("views", "cascades, spot views or cube faces in use"),
    of<&F::texels>("texels", "of the light's maps"),
    of<&F::bytes>("bytes", "everything the light holds"),
    of<&F::draws>("draws", "draw calls of the frame that draws every view"),
    of<&F::scored_px>("scored_px", "pixels that are compared"),
    of<&F::other_surface_px>("other_surface_px",
                             "pixels that are not, as the picture shows another surface than their ray meets"),
    of<&F::wrong>("wrong", "share of them on the other side of 1/2 than the truth about a point"),
    of<&F::false_shadow>("false_shadow", "share that is dark and should be lit"),
    of<&F::false_light>("false_light", "share that is lit and should be dark"),
    of<&F::acne>("acne", "share of false shadow more than 2 px from every true edge"),
    of<&F::leak>("leak", "share of false light more than 2 px from every true edge"),
    of<&F::false_shadow_far>("false_shadow_far",
                             "share of false shadow that neither an edge nor the map's texels there explain"),
    of<&F::false_light_far>("false_light_far", "the same of false light"),
    of<&F::mean_error>("mean_error", "mean difference from the truth about a point"),
    of<&F::edge_places>("edge_places", "places where a true shadow edge was looked for"),
    of<&F::edge_lost>("edge_lost", "of them without any edge within 8 px"),
    of<&F::edge_p50_px>("edge_p50_px", "how far off edges are, median"),
    of<&F::edge_p95_px>("edge_p95_px", "95th percentile"),
    of<&F::edge_p99_px>("edge_p99_px", "99th percentile"),
    of<&F::edge_max_px>("edge_max_px", "farthest; the search ends at 8 px"),
    of<&F::predicted_px>("predicted_px", "how far off the fit says edges may be"),
    of<&F::sub_texel_caster>("sub_texel_caster",
                             "places farther off than predicted there: shadow or light narrower than a texel"),
    of<&F::truth_ambiguous>("truth_ambiguous", "the same: the truth there hangs on the last digits"),
    of<&F::other_bias>("other_bias", "the same, for neither reason, under a bias that is not Gnomon's own"),
    of<&F::unexplained>("unexplained", "the same, for no reason"),
    of<&F::disk_error>("disk_error", "mean difference from the truth about a disk"),
    of<&F::umbra_leak>("umbra_leak", "mean light where none of the disk is seen"),
    of<&F::lit_loss>("lit_loss", "mean light missing where all of the disk is seen"),
    of<&F::penumbra_error>("penumbra_error", "mean difference between the two"),
    of<&F::width_ratio>("width_ratio", "width of penumbrae, of what is true there, median"),
    of<&F::area_error>("area_error", "mean difference from the lit share of a pixel's area, where an edge crosses it"),
    of<&F::area_bias>("area_bias", "its mean with its sign; above 0: too bright"),
    of<&F::area_p99>("area_p99", "its 99th percentile"),
    of<&F::gpu_us, &S::median>("gpu_us", "depth and lighting pass, every view drawn; median of rounds"),
    of<&F::gpu_us, &S::min>("gpu_us_min", "the least of the rounds"),
    of<&F::gpu_us, &S::max>("gpu_us_max", "the most of the rounds"),
    of<&F::gpu_ratio, &S::median>("gpu_ratio", "the same over the defaults' in the same round; median of rounds"),
    of<&F::gpu_ratio, &S::min>("gpu_ratio_min", "the least of the rounds"),
    of<&F::gpu_ratio, &S::max>("gpu_ratio_max", "the most of the rounds"),
    of<&F::kept_us, &S::median>("kept_us", "the same passes of a still scene, whose maps are kept"),
    of<&F::kept_us, &S::min>("kept_us_min", "the least of the rounds"),
    of<&F::kept_us, &S::max>("kept_us_max", "the most of the rounds"),
    of<&F::kept_ratio, &S::median>("kept_ratio", "the same over the defaults' in the same round; median of rounds"),
    of<&F::kept_ratio, &S::min>("kept_ratio_min", "the least of the rounds"),
    of<&F::kept_ratio, &S::max>("kept_ratio_max", "the most of the rounds"),
    of<&F::cpu_us, &S::median>("cpu_us", "CPU time of the light's shadow stages, every view drawn; median of rounds"),
    of<&F::cpu_us, &S::min>("cpu_us_min", "the least of the rounds"),
    of<&F::cpu_us, &S::max>("cpu_us_max", "the most of the rounds"),
};

}  // namespace

std::span<const FigureColumn> figure_columns() { return kColumns; }

}  // namespace gnomon::bench
