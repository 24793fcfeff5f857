#include "bench/filter_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "bench/filter_front.h"
#include "tests/oracle/metrics.h"
#include "tests/oracle/reference_tracer.h"
#include "tests/oracle/soft_metrics.h"

namespace gnomon::bench {
namespace {

// Fits, sizes and programs have settled then, and timings of a query that arrive late are those of the same filter.
constexpr int kSettlingFrames = 3;

/// What all rows are held against, and which of the snapshot's lights that is.
struct Truths {
    oracle::PrimaryHits hits;
    std::vector<oracle::LightTruth> point;
    std::vector<oracle::SoftTruth> disk;
    std::vector<std::uint32_t> lights;
};

std::optional<Error> apply_all(Stage& stage, const std::vector<std::string>& settings) {
    for (const std::string& setting : settings)
        if (auto error = stage.apply_setting(setting)) return error;
    return std::nullopt;
}

Result<Truths> trace(Stage& stage, FilterRows& rows) {
    if (auto error = apply_all(stage, disk_source())) return *error;
    stage.run_frame();
    const SceneSnapshot& scene = stage.frame().snapshot();
    if (scene.consumers.empty()) return Error{"no usable camera", stage.scene_name(), "", "bench.camera"};
    const oracle::ReferenceTracer tracer(scene, stage.library(), scene.consumers.front().position_ws_m);
    rows.size_px = scene.consumers.front().viewport_px;
    Truths truths;
    truths.hits = tracer.trace_primary(scene.consumers.front());
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
        if (!scene.lights[l].has_shadow) continue;
        truths.lights.push_back(l);
        truths.point.push_back(tracer.trace_light(truths.hits, scene.lights[l], true));
        truths.disk.push_back(tracer.trace_source(truths.hits, scene.lights[l], {}));
        rows.lights.push_back(scene.lights[l].name);
    }
    return truths;
}

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

std::optional<Error> judge(Stage& stage, const Truths& truths, const FilterVariant& variant, glm::uvec2 size_px,
                           std::vector<RowFigures>& lights) {
    stage.set_economy(true);
    for (int i = 0; i < kSettlingFrames; ++i) stage.run_frame();
    std::vector<float> measured;
    for (std::size_t k = 0; k < truths.lights.size(); ++k) {
        const LightReport& report = stage.frame().report().lights[truths.lights[k]];
        RowFigures& figures = lights.emplace_back();
        figures.taps = variant.row->taps(variant.shadow, report.kind == LightKind::point);
        figures.bytes = report.bytes;
        if (!stage.frame().read_visibility(truths.lights[k], measured))
            return Error{"visibility of light '" + report.name + "' cannot be read", stage.scene_name(), "",
                         "bench.visibility"};
        figures.disk_error = oracle::compare_soft(truths.hits, truths.disk[k], measured).mean_error;
        if (variant.by_source()) continue;
        const oracle::LightTruth& truth = truths.point[k];
        const auto metrics = oracle::compare({size_px, measured, truth.visibility, truth.scored, truth.ambiguous});
        figures.wrong = metrics.fraction(metrics.wrong);
        figures.blur = mean_difference(truth, measured);
    }
    return std::nullopt;
}

/// Median times of each light as it is set: with every view drawn, and with kept maps.
struct BlockTimes {
    std::vector<double> drawn_us, kept_us;
};
BlockTimes time_block(Stage& stage, const std::vector<std::uint32_t>& lights, std::uint32_t frames) {
    BlockTimes times;
    for (const bool kept : {false, true}) {
        stage.set_economy(kept);
        std::vector<std::vector<double>> all(lights.size());
        for (std::uint32_t i = 0; i < kSettlingFrames + frames; ++i) {
            stage.run_frame();
            for (std::size_t k = 0; i >= kSettlingFrames && k < lights.size(); ++k)
                if (const auto us = stage.frame().report().lights[lights[k]].gpu_us) all[k].push_back(*us);
        }
        for (const auto& light : all) (kept ? times.kept_us : times.drawn_us).push_back(spread_of(light).median);
    }
    return times;
}

/// Each variant right after `hard`, so that what slows the machine for a while slows both.
std::optional<Error> time_rows(Stage& stage, const FilterRowsOptions& options, const Truths& truths,
                               const std::vector<FilterVariant>& variants,
                               std::vector<std::vector<RowFigures>>& figures) {
    const FilterVariant& hard = variants.front();
    for (std::size_t v = 0; v < variants.size(); ++v) {
        std::vector<std::vector<double>> drawn(truths.lights.size()), kept(truths.lights.size());
        for (std::uint32_t round = 0; round < options.rounds; ++round) {
            if (auto error = apply_all(stage, hard.settings)) return error;
            const BlockTimes base = time_block(stage, truths.lights, options.frames);
            if (auto error = apply_all(stage, variants[v].settings)) return error;
            const BlockTimes times = time_block(stage, truths.lights, options.frames);
            for (std::size_t k = 0; k < truths.lights.size(); ++k) {
                if (base.drawn_us[k] > 0.0) drawn[k].push_back(times.drawn_us[k] / base.drawn_us[k]);
                if (base.kept_us[k] > 0.0) kept[k].push_back(times.kept_us[k] / base.kept_us[k]);
            }
        }
        for (std::size_t k = 0; k < truths.lights.size(); ++k) {
            figures[v][k].drawn = spread_of(drawn[k]);
            figures[v][k].kept = spread_of(kept[k]);
        }
    }
    return std::nullopt;
}

}  // namespace

Result<FilterRows> measure_filter_rows(Stage& stage, const FilterRowsOptions& options) {
    FilterRows rows;
    rows.scene = stage.scene_name();
    rows.device = stage.device().info().name;
    rows.variants = filter_variants();
    std::erase_if(rows.variants, [&](const FilterVariant& v) {
        return v.row->id != ShadowFilter::hard && v.name.find(options.only) == std::string::npos;
    });
    const auto truths = trace(stage, rows);
    if (!truths) return truths.error();
    rows.resolutions_px = {std::bit_floor(std::max(rows.size_px.x, rows.size_px.y)), 0};
    for (const std::uint32_t resolution_px : rows.resolutions_px) {
        auto& figures = rows.figures.emplace_back(rows.variants.size());
        if (auto error = stage.apply_setting("resolution=" + std::to_string(resolution_px))) return *error;
        for (std::size_t v = 0; v < rows.variants.size(); ++v) {
            if (auto error = apply_all(stage, rows.variants[v].settings)) return *error;
            if (auto error = judge(stage, truths.value(), rows.variants[v], rows.size_px, figures[v])) return *error;
        }
        if (options.frames == 0) continue;
        if (auto error = time_rows(stage, options, truths.value(), rows.variants, figures)) return *error;
    }
    return rows;
}

std::vector<std::uint8_t> FilterRows::front(std::size_t resolution, std::size_t light, RowTruth truth,
                                            RowCost cost) const {
    std::vector<ErrorAndCost> choices;
    std::vector<std::size_t> judged;
    for (std::size_t v = 0; v < variants.size(); ++v) {
        const RowFigures& row = figures[resolution][v][light];
        if (truth == RowTruth::point && !row.wrong) continue;
        judged.push_back(v);
        choices.push_back({truth == RowTruth::point ? *row.wrong : row.disk_error,
                           cost == RowCost::drawn ? row.drawn.median : row.kept.median});
    }
    const std::vector<std::uint8_t> best = on_front(choices);
    std::vector<std::uint8_t> all(variants.size(), 0);
    for (std::size_t i = 0; i < judged.size(); ++i) all[judged[i]] = best[i];
    return all;
}

std::vector<std::string> FilterRows::never_best() const {
    std::vector<std::string> names;
    for (const FilterVariant& variant : variants)
        if (names.empty() || names.back() != variant.row->name) names.emplace_back(variant.row->name);
    for (std::size_t r = 0; r < resolutions_px.size(); ++r)
        for (std::size_t l = 0; l < lights.size(); ++l)
            for (const RowTruth truth : kRowTruths)
                for (const RowCost cost : kRowCosts) {
                    const std::vector<std::uint8_t> best = front(r, l, truth, cost);
                    for (std::size_t v = 0; v < variants.size(); ++v)
                        if (best[v]) std::erase(names, variants[v].row->name);
                }
    return names;
}

}  // namespace gnomon::bench
