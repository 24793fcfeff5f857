#include "bench/check/check_judge.h"

#include <cmath>
#include <numbers>

#include "bench/accuracy/unexplained_errors.h"
#include "bench/text/printf_string.h"
#include "tests/oracle/metrics.h"
#include "tests/oracle/soft_metrics.h"

namespace gnomon::bench {
namespace {

constexpr float kHalf = 0.5f;
constexpr double kByteStep = 1.0 / 255.0;
constexpr std::uint32_t kTruthRays = 256;  // rays of oracle::SourceSampling, along both sides of its square

bool softens(const shadow::FilterRow& filter) { return filter.width == shadow::FilterWidth::source; }

/// Returns whether a filter estimates: blurred moments and searched blockers
/// only bound on which side of a half a value lies.
bool estimates(const shadow::FilterRow& filter) { return filter.moments || (softens(filter) && !filter.rays); }

/// Returns the truth where the measured value is within the tolerance of it, and
/// its opposite elsewhere; NaN and -1 stay.
std::vector<float> held_against(const std::vector<float>& truth, const std::vector<float>& measured, double tolerance) {
    std::vector<float> shown = measured;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (!(measured[i] >= 0.0f)) continue;
        const bool near = static_cast<double>(std::abs(measured[i] - truth[i])) <= tolerance;
        shown[i] = near ? truth[i] : 1.0f - truth[i];
    }
    return shown;
}

std::size_t unexplained(Stage& stage, const TracedTruths& truths, const TracedLight& light,
                        const oracle::LightTruth& truth, const std::vector<float>& measured, double tolerance) {
    const SceneSnapshot& scene = stage.frame().snapshot();
    const EdgeBounds bounds(scene, stage.device().info(), stage.frame().fit_history());
    const oracle::FarErrors far =
        errors_beyond_texels({*truths.tracer, truths.hits, truths.creases, scene, light.index, truth}, bounds,
                             held_against(truth.visibility, measured, tolerance));
    return far.false_shadow + far.false_light;
}

oracle::Metrics compare(const TracedTruths& truths, const oracle::LightTruth& truth,
                        const std::vector<float>& measured) {
    return oracle::compare({truths.hits.size_px, measured, truth.visibility, truth.scored, truth.ambiguous});
}

/// Converts the truth about a disk to one about a point. Pixels that see all of
/// the disk (or else none) are judged; others are not. The edge is between the
/// two, so that a penumbra may begin as far off as texels explain.
oracle::LightTruth one_side(const TracedLight& light, bool all_of_it) {
    oracle::LightTruth truth = light.point;
    for (std::size_t i = 0; i < truth.visibility.size(); ++i) {
        if (!(light.disk.visibility[i] >= 0.0f)) continue;
        const bool on_side = all_of_it ? light.disk.visibility[i] >= 1.0f : light.disk.visibility[i] <= 0.0f;
        truth.visibility[i] = on_side == all_of_it ? 1.0f : 0.0f;
        truth.scored[i] = light.disk.scored[i];
        truth.ambiguous[i] = truth.ambiguous[i] != 0 || !on_side ? 1 : 0;
    }
    return truth;
}

void add(const oracle::Metrics& metrics, CheckErrors& errors) {
    errors.scored += metrics.scored;
    errors.wrong += metrics.wrong;
    errors.acne += metrics.acne;
    errors.leak += metrics.leak;
    errors.uncovered += metrics.uncovered;
}

/// Returns the mean error of a fair coin's share of n throws, compared with that
/// of kTruthRays: no penumbra of random rays is worse.
double worst_penumbra_error(std::uint32_t rays) {
    const double variance = 0.25 * (1.0 / rays + 1.0 / kTruthRays);
    return std::sqrt(variance * 2.0 * std::numbers::inv_pi);
}

}  // namespace

double row_tolerance(const shadow::FilterRow& filter, std::uint32_t rays) {
    if (estimates(filter)) return static_cast<double>(kHalf);
    return filter.rays && filter.rays->per_source ? 1.0 / rays + kByteStep : kByteStep;
}

CheckErrors judge_check_row(Stage& stage, const TracedTruths& truths, const TracedLight& light,
                            const std::vector<float>& measured, const shadow::FilterRow& filter, double tolerance) {
    CheckErrors errors;
    if (!softens(filter)) {
        add(compare(truths, light.point, measured), errors);
        errors.unexplained = unexplained(stage, truths, light, light.point, measured, tolerance);
        return errors;
    }
    for (const bool all_of_it : {false, true}) {
        const oracle::LightTruth truth = one_side(light, all_of_it);
        add(compare(truths, truth, measured), errors);
        errors.unexplained += unexplained(stage, truths, light, truth, measured, tolerance);
    }
    errors.penumbra_error = oracle::compare_soft(truths.hits, light.disk, measured).penumbra_error;
    return errors;
}

std::string broken_bound(const shadow::FilterRow& filter, std::uint32_t rays, const CheckErrors& errors) {
    if (errors.scored == 0) return "no pixel to judge";
    if (errors.uncovered > 0) return formatted("%zu pixels without a value", errors.uncovered);
    if (errors.unexplained > 0)
        return formatted(
            "%zu pixels wrong where neither an edge nor the map's "
            "texels explain it",
            errors.unexplained);
    if (filter.rays && !filter.rays->per_source && errors.wrong > 0)
        return formatted("%zu pixels wrong, none may be", errors.wrong);
    if (filter.rays && filter.rays->per_source && errors.penumbra_error) {
        const double most = worst_penumbra_error(rays);
        if (!(*errors.penumbra_error <= most))
            return formatted("penumbras off by %.3f, %u rays by %.3f at most", *errors.penumbra_error, rays, most);
    }
    return {};
}

}  // namespace gnomon::bench
