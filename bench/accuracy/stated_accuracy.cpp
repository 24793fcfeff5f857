#include "bench/accuracy/stated_accuracy.h"

#include <algorithm>

#include "bench/text/printf_string.h"
#include "systems/shadow/request/filter_table.h"

namespace gnomon::bench {
namespace {

/// Returns whether edges are counted. Penumbrae of a source with a size have none.
bool has_edges(const LightAccuracy& light) {
    return !is_left_out(light.report) && !light.soft && light.resolved.places > 0;
}

bool keeps_edges(const LightAccuracy& light) {
    return !has_edges(light) || light.resolved.p999_px <= light.report.predicted_error_px;
}

}  // namespace

bool is_as_stated(const LightAccuracy& light) { return keeps_edges(light) && light.needs_wider == 0; }

bool fails_bench(const LightAccuracy& light) {
    const shadow::FilterRow& row = shadow::filter_row(light.report.filter.filter);
    return (row.storage.triangle_ids || row.rays) && !is_as_stated(light);
}

double slack_of(const LightAccuracy& light) {
    return light.report.predicted_error_px / std::max(light.resolved.p99_px, kLeastTold_px);
}

std::string broken_words(const LightAccuracy& light) {
    std::string text;
    if (!keeps_edges(light))
        text = formatted(
            "edges of what the map resolves are off by %.2f px at one place in a thousand, %.2f px are stated",
            light.resolved.p999_px, light.report.predicted_error_px);
    if (light.needs_wider > 0)
        text += formatted("%s%zu pixels need a wider caster than %.3g m", text.empty() ? "" : "; ", light.needs_wider,
                          light.report.resolved.m);
    return text;
}

}  // namespace gnomon::bench
