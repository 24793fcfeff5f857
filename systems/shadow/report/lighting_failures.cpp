#include "systems/shadow/report/lighting_failures.h"

#include <algorithm>

namespace gnomon::shadow {
namespace {

/// Returns what both of two lookups resolve.
ResolvedWidth wider(const ResolvedWidth& a, const ResolvedWidth& b) {
    return {std::max(a.px, b.px), std::max(a.m, b.m), a.keeps_narrowest && b.keeps_narrowest};
}

/// Describes a light without its shadow, or not drawn at all.
void add_unshadowed(const LookupFailure& failure, LightReport& report) {
    report.state = LightState::skipped;
    report.reason = failure.reason;
    report.filter = {};
    report.predicted_error_px = report.why.stale_px = 0.0;
    report.keeps_max_error = false;
    report.resolved = {};
    report.counts.views = report.views.count = 0;
}

/// Describes one tap of the light's map in the place of its own row.
void add_fallback(const LookupFailure& failure, LightReport& report) {
    const LookupAccuracy& plain = failure.fallback;
    const bool again = report.filter.filter == plain.filter && report.filter.reason == failure.reason;
    report.state = LightState::degraded;
    report.reason = failure.reason;
    report.filter = {plain.filter, failure.reason, {}, {}};
    report.predicted_error_px =
        again ? std::max(report.predicted_error_px, plain.predicted_error_px) : plain.predicted_error_px;
    report.keeps_max_error = plain.keeps_max_error && (!again || report.keeps_max_error);
    report.resolved = again ? wider(report.resolved, plain.resolved) : plain.resolved;
}

/// Describes a failure on blended surfaces or shadow catchers alone: on all others the report holds already.
void add_forward(const LookupFailure& failure, LightReport& report) {
    report.state = LightState::degraded;
    report.reason = failure.reason;
    report.predicted_error_px = std::max(report.predicted_error_px, failure.fallback.predicted_error_px);
    report.keeps_max_error = report.keeps_max_error && !failure.unshadowed && failure.fallback.keeps_max_error;
    report.resolved = wider(report.resolved, failure.fallback.resolved);
    report.resolved.keeps_narrowest = report.resolved.keeps_narrowest && !failure.unshadowed;
}

}  // namespace

void add_outcome(const LightingOutcome& outcome, FrameReport& report) {
    for (const LookupFailure& failure : outcome.failures) {
        LightReport& light = report.lights[failure.light];
        const bool skipped = light.state == LightState::skipped;  // in another picture
        if (failure.unshadowed && !failure.forward_only)
            add_unshadowed(failure, light);
        else if (!skipped && failure.forward_only)
            add_forward(failure, light);
        else if (!skipped)
            add_fallback(failure, light);
    }
    for (const CachedLookup& cached : outcome.cached) {
        LightReport& light = report.lights[cached.light];
        light.kept.bytes += cached.bytes;
        light.counts.bytes += cached.bytes;
        if (!cached.reused) continue;
        light.kept.reason = Reason::visibility_kept;
        light.kept.saved_us = cached.saved_us;
    }
    report.failure = outcome.failure;
    report.rays.list_bytes = outcome.ray_list_bytes;
    report.rays.place_bytes = outcome.position_bytes;
}

}  // namespace gnomon::shadow
