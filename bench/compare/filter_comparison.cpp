#include "bench/compare/filter_comparison.h"

#include <algorithm>
#include <bit>

#include "bench/compare/evaluate_configuration.h"
#include "bench/compare/paired_times.h"
#include "bench/compare/pareto_front.h"

namespace gnomon::bench {
namespace {

FilterVariant at_size(FilterVariant variant, std::uint32_t resolution_px) {
    variant.settings.push_back("resolution=" + std::to_string(resolution_px));
    return variant;
}

/// Times each variant right after `hard`, so that a machine that slows down for a while slows both.
void time_rows(Stage& stage, const FilterRowsOptions& options, const TracedTruths& truths,
               const std::vector<FilterVariant>& variants, std::vector<std::vector<RowFigures>>& figures) {
    const BlockOptions block = block_options(stage.device().info(), options.frames);
    for (std::size_t v = 0; v < variants.size(); ++v) {
        std::vector<RatioRounds> rounds(truths.lights.size());
        for (std::uint32_t round = 0; round < options.rounds; ++round) {
            const auto base = time_block(stage, truths.indices(), variants.front(), block);
            const auto times = time_block(stage, truths.indices(), variants[v], block);
            for (std::size_t k = 0; k < rounds.size(); ++k) rounds[k].add(times[k], base[k]);
        }
        for (std::size_t k = 0; k < rounds.size(); ++k) rounds[k].put_into(figures[v][k]);
    }
}

std::optional<Error> judge_rows(Stage& stage, const TracedTruths& truths, const std::vector<FilterVariant>& variants,
                                std::vector<std::vector<RowFigures>>& figures) {
    for (const FilterVariant& variant : variants) {
        const JudgedRow row = judge_row(stage, truths, variant, {.edges = false});
        if (row.error) return Error{*row.error, stage.scene_name(), "", "bench.row"};
        auto& lights = figures.emplace_back();
        for (const LightRow& light : row.lights) lights.push_back(light.figures);
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
    const auto truths = trace_truths(stage, {.disks = true});
    if (!truths) return truths.error();
    rows.size_px = truths.value().hits.size_px;
    for (const TracedLight& light : truths.value().lights) rows.lights.push_back(light.name);
    rows.resolutions_px = {std::bit_floor(std::max(rows.size_px.x, rows.size_px.y)), 0};
    for (const std::uint32_t resolution_px : rows.resolutions_px) {
        std::vector<FilterVariant> variants;
        for (const FilterVariant& variant : rows.variants) variants.push_back(at_size(variant, resolution_px));
        auto& figures = rows.figures.emplace_back();
        if (auto error = judge_rows(stage, truths.value(), variants, figures)) return *error;
        if (options.frames > 0) time_rows(stage, options, truths.value(), variants, figures);
    }
    return rows;
}

std::vector<std::uint8_t> FilterRows::front(std::size_t resolution, std::size_t light, RowTruth truth,
                                            RowCost cost) const {
    std::vector<ErrorAndCost> choices;
    std::vector<std::size_t> judged;
    for (std::size_t v = 0; v < variants.size(); ++v) {
        const RowFigures& row = figures[resolution][v][light];
        if (!is_judged(resolution, v, light, truth)) continue;
        judged.push_back(v);
        choices.push_back({truth == RowTruth::point ? *row.wrong : *row.disk_error,
                           cost == RowCost::drawn ? row.gpu_ratio.median : row.kept_ratio.median});
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
