#include "bench/accuracy/stated_accuracy.h"

#include <algorithm>

#include "bench/text/printf_string.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::bench {
namespace {

/// Returns whether edges are as near as stated. Penumbrae of a source with a size have none. Nor have lit shares of
/// pixels' areas: a shadow narrower than a pixel is nowhere half dark.
bool keeps_edges(const LightAccuracy& light) {
    return !light.edges || light.soft || shows_areas(light) || light.edges->resolved.places == 0 ||
           light.edges->resolved.p999_px <= light.report.predicted_error_px;
}

bool keeps_width(const LightAccuracy& light) { return !light.edges || light.edges->needs_wider == 0; }

}  // namespace

bool is_as_stated(const LightAccuracy& light) { return keeps_edges(light) && keeps_width(light); }

bool fails_bench(const LightAccuracy& light) {
    const shadow::FilterRow& row = shadow::filter_row(light.report.filter.filter);
    return (row.storage.triangle_ids || row.rays) && !is_as_stated(light);
}

double slack_of(const LightAccuracy& light) {
    return light.report.predicted_error_px / std::max(light.edges ? light.edges->resolved.p99_px : 0.0, kLeastTold_px);
}

std::string broken_words(const LightAccuracy& light) {
    std::string text;
    if (!keeps_edges(light))
        text = formatted(
            "edges of what the map resolves are off by %.2f px at one place in a thousand, %.2f px are stated",
            light.edges->resolved.p999_px, light.report.predicted_error_px);
    if (!keeps_width(light))
        text += formatted("%s%zu pixels need a wider caster than %.3g m", text.empty() ? "" : "; ",
                          light.edges->needs_wider, light.report.resolved.m);
    return text;
}

}  // namespace gnomon::bench
