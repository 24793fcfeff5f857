#include "bench/check/check_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/accuracy/edge_error_bounds.h"
#include "bench/check/check_judge.h"
#include "bench/compare/evaluate_configuration.h"
#include "bench/compare/paired_times.h"
#include "sample_game/support/settings/light_settings.h"
#include "systems/extract/light_facts.h"
#include "systems/shadow/request/light_kinds.h"
#include "systems/shadow/update/cube_layering.h"

namespace gnomon::bench {
namespace {

/// Texels of a small picture's pixels and less, so that the band in which they
/// explain errors is a few pixels wide.
constexpr const char* kMapSetting = "resolution=512";
/// Wide enough for penumbras of several pixels.
constexpr std::array<const char*, 2> kSource = {"source_radius_m=0.12", "sun_radius_deg=3"};

constexpr std::array<std::pair<CubeRoute, const char*>, 3> kRoutes = {
    {{CubeRoute::six_passes, "six_passes"},
     {CubeRoute::layered_vertex, "layered_vertex"},
     {CubeRoute::layered_geometry, "layered_geometry"}}};

CheckRowSetup setup_of(const shadow::LightKindRow& kind, const shadow::FilterRow& filter) {
    CheckRowSetup setup;
    setup.kind = kind.kind;
    setup.kinds = only(kind.kind);
    setup.filter = &filter;
    setup.name = std::string(kind.name) + " " + std::string(filter.name);
    setup.settings = {"filter=" + std::string(filter.name), kMapSetting};
    if (filter.width == shadow::FilterWidth::source && !light_facts(kind.kind).area())
        setup.settings.insert(setup.settings.end(), kSource.begin(), kSource.end());
    return setup;
}

std::uint32_t rays_of(const CheckRowSetup& setup) {
    game::LightSettings settings;
    for (const std::string& setting : setup.settings) (void)game::apply_setting(settings, setting);
    return settings.tuning.kernel.penumbra_rays;
}

Spread time_frames_of(Stage& stage, std::uint32_t light, bool kept, const BlockOptions& options) {
    stage.set_economy(kept);
    std::vector<double> us;
    for (std::uint32_t i = 0; i < options.settling + options.frames; ++i) {
        stage.run_frame();
        const auto& gpu_us = stage.frame().report().lights[light].gpu_us;
        if (i >= options.settling && gpu_us) us.push_back(*gpu_us);
    }
    return spread_of(std::move(us));
}

const TracedLight* light_of(const TracedTruths& truths, LightKind kind) {
    for (const TracedLight& light : truths.lights)
        if (light.kind == kind) return &light;
    return nullptr;
}

void fail(CheckRow& row, std::string why) {
    row.verdict = CheckVerdict::failed;
    row.why = std::move(why);
}

/// Returns why the device or the filter draws a cube's faces by another route than the row's; empty: by the same.
std::string why_not_judged(const CheckRowSetup& setup, const gl::DeviceInfo& info) {
    constexpr std::uint32_t kFaces = 6;
    if (setup.route == CubeRoute::automatic || setup.route == CubeRoute::six_passes) return {};
    if (setup.filter->rays) return "its maps are peeled face by face, in six passes";
    if (shadow::cube_route(setup.route, info, kFaces) != setup.route)
        return "this device cannot; six passes are drawn instead";
    return {};
}

/// Returns whether a light has all of its maps, new or kept from the frame
/// before, and its own filter. Another filter stands in for a missing program.
bool drawn_as_asked(const LightRow& light) {
    const bool kept =
        light.state == to_text(LightState::reused) && light.reason == reason_code(Reason::content_unchanged);
    return kept || (light.state == to_text(LightState::rendered) && light.reason.empty());
}

/// Judges the row's picture by the truth.
void judge(Stage& stage, const TracedTruths& truths, CheckRow& row) {
    const std::uint32_t rays = rays_of(row.setup);
    row.tolerance = row_tolerance(*row.setup.filter, rays);
    const auto on_measured = [&](const TracedLight& light, const std::vector<float>& measured) {
        row.errors = judge_check_row(stage, truths, light, measured, *row.setup.filter, row.tolerance);
        row.map_px = EdgeBounds(stage.frame().snapshot(), stage.device().info(), stage.frame().fit_history())
                         .map_px(light.index);
    };
    const JudgedRow judged = judge_row(stage, truths, row.setup, {.edges = false, .on_measured = on_measured});
    if (judged.error) return fail(row, *judged.error);
    if (judged.lights.size() != 1) return fail(row, "no light of this kind");
    const LightRow& light = judged.lights.front();
    row.bytes = light.figures.bytes.value_or(0.0);
    if (!drawn_as_asked(light)) return fail(row, light.state + (light.reason.empty() ? "" : ": " + light.reason));
    row.why = broken_bound(*row.setup.filter, rays, row.errors);
    row.verdict = row.why.empty() ? CheckVerdict::ok : CheckVerdict::failed;
}

}  // namespace

const char* to_text(CheckVerdict verdict) {
    return verdict == CheckVerdict::ok ? "ok" : verdict == CheckVerdict::failed ? "FAIL" : "not judged";
}

std::vector<CheckRowSetup> check_row_setups() {
    std::vector<CheckRowSetup> setups;
    for (const shadow::LightKindRow& kind : shadow::light_kind_table())
        for (const shadow::FilterRow& filter : shadow::filter_table()) {
            const bool area = light_facts(kind.kind).area();
            // Filters that see the middle alone look an area light up as a point.
            if (area && filter.width != shadow::FilterWidth::source) continue;
            // Cubes of area lights are drawn as those of a point.
            if (area || kind.texture != gl::TextureKind::cube) {
                setups.push_back(setup_of(kind, filter));
                continue;
            }
            for (const auto& [route, name] : kRoutes) {
                CheckRowSetup& setup = setups.emplace_back(setup_of(kind, filter));
                setup.route = route;
                setup.name += std::string(" ") + name;
                setup.settings.push_back(std::string("cube_route=") + name);
            }
        }
    return setups;
}

Result<TracedTruths> trace_check_truths(Stage& stage, std::span<const CheckRowSetup> rows) {
    auto truths = trace_truths(stage);
    const bool of_sources = std::any_of(
        rows.begin(), rows.end(), [](const auto& row) { return row.filter->width == shadow::FilterWidth::source; });
    if (!truths || !of_sources) return truths;
    const std::vector<std::string> source(kSource.begin(), kSource.end());
    if (auto error = stage.start_over(source)) return *error;
    stage.run_frame();
    const SceneSnapshot& scene = stage.frame().snapshot();
    for (TracedLight& light : truths.value().lights)
        light.disk = truths.value().tracer->trace_source(truths.value().hits, scene.lights[light.index], {});
    return truths;
}

CheckRow check_row(Stage& stage, const TracedTruths& truths, const CheckRowSetup& setup,
                   const RowCheckOptions& options) {
    CheckRow row;
    row.setup = setup;
    row.setup.settings.insert(row.setup.settings.end(), options.settings.begin(), options.settings.end());
    row.why = why_not_judged(setup, stage.device().info());
    if (!row.why.empty()) return row;
    const TracedLight* light = light_of(truths, setup.kind);
    if (!light) {
        fail(row, "no light of this kind");
        return row;
    }
    judge(stage, truths, row);
    if (options.frames == 0 || row.verdict == CheckVerdict::failed) return row;
    const BlockOptions block = block_options(stage.device().info(), options.frames);
    row.drawn_us = time_frames_of(stage, light->index, false, block);
    row.kept_us = time_frames_of(stage, light->index, true, block);
    return row;
}

}  // namespace gnomon::bench
