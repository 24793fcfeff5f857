#include "bench/compare/evaluate_configuration.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "bench/accuracy/edge_error_bounds.h"
#include "bench/accuracy/unexplained_errors.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/oracle/edge_exceptions.h"
#include "tests/oracle/metrics.h"
#include "tests/oracle/soft_metrics.h"

namespace gnomon::bench {
namespace {

// Fits, sizes and programs have settled then.
constexpr int kSettlingFrames = 3;

double mean_difference(const oracle::LightTruth& truth, const std::vector<float>& measured) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (!truth.scored[i] || truth.ambiguous[i]) continue;
        const float off = std::abs(measured[i] - truth.visibility[i]);
        sum += off <= 1.0f ? static_cast<double>(off) : 1.0;  // no surface there, or not a number
        ++count;
    }
    return count > 0.0 ? sum / count : 0.0;
}

double median_px(const oracle::EdgeDisplacement& edge) {
    std::vector<double> off_px;
    for (const oracle::EdgeDisplacement::Place& place : edge.each) off_px.push_back(place.off_px);
    return spread_of(std::move(off_px)).median;
}

void judge_edges(Stage& stage, const TracedTruths& truths, const TracedLight& light,
                 const oracle::EdgeDisplacement& edge, RowFigures& figures) {
    const SceneSnapshot& scene = stage.frame().snapshot();
    const EdgeBounds bounds(scene, stage.device().info(), stage.frame().fit_history());
    const auto exceptions = oracle::edge_exceptions(
        *truths.tracer, truths.hits, scene.consumers.front(), scene.lights[light.index], light.point, edge,
        [&](const glm::dvec3& point, const glm::dvec3& normal) { return bounds.at(light.index, point, normal); });
    figures.sub_texel_caster = static_cast<double>(exceptions.sub_texel_caster);
    figures.truth_ambiguous = static_cast<double>(exceptions.truth_ambiguous);
    // What is predicted rests on the bias.
    const bool own_bias = scene.lights[light.index].tuning.bias.mode == BiasMode::automatic;
    const auto others = static_cast<double>(exceptions.unexplained);
    figures.other_bias = own_bias ? 0.0 : others;
    figures.unexplained = own_bias ? others : 0.0;
}

void judge_far(Stage& stage, const TracedTruths& truths, const TracedLight& light, const std::vector<float>& measured,
               RowFigures& figures) {
    const SceneSnapshot& scene = stage.frame().snapshot();
    const EdgeBounds bounds(scene, stage.device().info(), stage.frame().fit_history());
    const oracle::FarErrors far = errors_beyond_texels(
        {*truths.tracer, truths.hits, truths.creases, scene, light.index, light.point}, bounds, measured);
    const double scored = std::max(figures.scored_px.value_or(0.0), 1.0);
    figures.false_shadow_far = static_cast<double>(far.false_shadow + far.crease_shadow) / scored;
    figures.false_light_far = static_cast<double>(far.false_light + far.crease_light) / scored;
}

oracle::EdgeDisplacement judge_by_point(const TracedTruths& truths, const TracedLight& light,
                                        const std::vector<float>& measured, RowFigures& figures) {
    oracle::Metrics m = oracle::compare(
        {truths.hits.size_px, measured, light.point.visibility, light.point.scored, light.point.ambiguous});
    figures.scored_px = static_cast<double>(m.scored);
    if (light.other_surface) figures.other_surface_px = static_cast<double>(*light.other_surface);
    figures.wrong = m.fraction(m.wrong);
    figures.false_shadow = m.fraction(m.false_shadow);
    figures.false_light = m.fraction(m.false_light);
    figures.acne = m.fraction(m.acne);
    figures.leak = m.fraction(m.leak);
    figures.mean_error = mean_difference(light.point, measured);
    figures.edge_places = static_cast<double>(m.edge.places);
    figures.edge_lost = static_cast<double>(m.edge.lost);
    figures.edge_p50_px = median_px(m.edge);
    figures.edge_p95_px = m.edge.p95_px;
    figures.edge_p99_px = m.edge.p99_px;
    figures.edge_max_px = m.edge.max_px;
    return std::move(m.edge);
}

void judge_by_disk(const TracedTruths& truths, const TracedLight& light, const std::vector<float>& measured,
                   RowFigures& figures) {
    const oracle::SoftMetrics m = oracle::compare_soft(truths.hits, light.disk, measured);
    figures.disk_error = m.mean_error;
    figures.umbra_leak = m.umbra_leak;
    figures.lit_loss = m.lit_loss;
    figures.penumbra_error = m.penumbra_error;
    if (m.widths.places > 0) figures.width_ratio = m.widths.median_ratio;
}

void judge_by_area(const TracedLight& light, const std::vector<float>& measured, RowFigures& figures) {
    const oracle::AreaMetrics m = oracle::compare_area(light.area, measured, light.point.ambiguous);
    if (m.crossed == 0) return;
    figures.area_error = m.mean_error;
    figures.area_bias = m.bias;
    figures.area_p99 = m.p99_error;
}

/// Copies the light's report into the row. `draws`: most of any frame since the row began.
void take_report(const LightItem& light, const LightReport& report, std::uint32_t draws, LightRow& row) {
    row.kind = light.kind;
    row.state = to_text(report.state);
    row.reason = report.reason == Reason::none ? "" : reason_code(report.reason);
    RowFigures& figures = row.figures;
    const bool chosen = light.shadow.filter == ShadowFilter::automatic;
    const ShadowFilter filter = chosen ? report.filter.filter : light.shadow.filter;
    figures.taps = shadow::filter_row(filter).taps(light.tuning.kernel,
                                                   shadow::light_kind_row(light.kind).texture == gl::TextureKind::cube);
    figures.views = report.counts.views;
    figures.texels = static_cast<double>(report.counts.texels);
    figures.bytes = static_cast<double>(report.counts.bytes);
    figures.draws = draws;
    figures.predicted_px = report.predicted_error_px;
}

std::optional<Error> judge_lights(Stage& stage, const TracedTruths& truths, const RowSetup& setup,
                                  const JudgeOptions& options, std::vector<LightRow>& lights) {
    if (auto error = stage.start_over(setup.settings, setup.kinds)) return error;
    std::vector<std::uint32_t> draws(truths.lights.size(), 0);
    for (int i = 0; i < kSettlingFrames; ++i) {
        stage.run_frame();
        const FrameReport& report = stage.frame().report();
        for (std::size_t k = 0; k < draws.size(); ++k)
            draws[k] = std::max(draws[k], report.lights[truths.lights[k].index].counts.draws);
    }
    std::vector<float> measured;
    for (std::size_t k = 0; k < truths.lights.size(); ++k) {
        const TracedLight& traced = truths.lights[k];
        if (!holds(setup.kinds, traced.kind)) continue;
        const LightItem& item = stage.frame().snapshot().lights[traced.index];
        LightRow& row = lights.emplace_back();
        row.light = traced.name;
        take_report(item, stage.frame().report().lights[traced.index], draws[k], row);
        if (!stage.frame().read_visibility(traced.index, measured))
            return Error{"the visibility of light '" + traced.name + "' cannot be read", "", "", "bench.visibility"};
        const bool judged = !is_left_out(stage.frame().report().lights[traced.index]);
        if (judged && !traced.disk.visibility.empty()) judge_by_disk(truths, traced, measured, row.figures);
        // A source with a size has no true edge, and half of it in sight is no error.
        if (judged && shadow::filter_row(item.shadow.filter).width != shadow::FilterWidth::source) {
            const oracle::EdgeDisplacement edge = judge_by_point(truths, traced, measured, row.figures);
            if (!traced.area.lit.empty()) judge_by_area(traced, measured, row.figures);
            if (options.edges) judge_edges(stage, truths, traced, edge, row.figures);
            if (options.edges && setup.settings.empty()) judge_far(stage, truths, traced, measured, row.figures);
        }
        if (options.on_measured) options.on_measured(traced, measured);
    }
    return std::nullopt;
}

}  // namespace

JudgedRow judge_row(Stage& stage, const TracedTruths& truths, const RowSetup& setup, const JudgeOptions& options) {
    JudgedRow row{setup.name, std::nullopt, {}};
    try {
        if (const auto error = judge_lights(stage, truths, setup, options, row.lights)) row.error = to_line(*error);
    } catch (const std::exception& failure) {
        row.error = failure.what();
    }
    if (row.error) row.lights.clear();
    return row;
}

}  // namespace gnomon::bench
