#include "bench/culling.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/math/frustum.h"
#include "systems/extract/scene_tree.h"
#include "systems/shadow/demand.h"
#include "systems/shadow/filter_table.h"
#include "systems/shadow/fit.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/sets.h"
#include "systems/shadow/view_casters.h"

namespace gnomon::bench {
namespace {

/// Boxes of about a metre on a plain, four to a hundred square metres, with a light of `kind` and a camera above them.
/// `sight_m`: how far the camera sees; as far as the plain goes if 0.
SceneSnapshot plain(std::int64_t boxes, LightKind kind, double sight_m) {
    std::mt19937_64 random(7);
    const double side_m = 5.0 * std::sqrt(static_cast<double>(boxes));
    const auto number = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    SceneSnapshot scene;
    for (std::int64_t i = 0; i < boxes; ++i) {
        InstanceItem item;
        item.mesh = static_cast<std::uint32_t>(i % 50);
        item.gpu_slot = static_cast<std::uint32_t>(i);
        const glm::dvec3 centre(number(-0.5, 0.5) * side_m, number(0.0, 2.0), number(-0.5, 0.5) * side_m);
        const glm::dvec3 half(number(0.2, 1.0), number(0.2, 2.0), number(0.2, 1.0));
        item.bounds_ws = {centre - half, centre + half};
        item.casts = true;
        scene.instances.push_back(item);
    }
    ConsumerItem camera;
    camera.position_ws_m = {0.0, 10.0, 0.5 * side_m};
    camera.rotation_ws = math::basis_from_back(glm::dvec3(0.0, 0.3, 1.0));
    camera.fov_y_rad = 1.2;
    camera.far_m = sight_m > 0.0 ? sight_m : 4.0 * side_m;
    scene.consumers.push_back(camera);
    LightItem light;
    light.kind = kind;
    light.intensity = 1.0f;
    light.has_shadow = true;
    light.shadow.resolution_px = 2048;
    light.position_ws_m = {0.0, 40.0, 0.5 * side_m - 40.0};
    light.rotation_ws = math::basis_from_back(glm::dvec3(0.4, 1.0, 0.2));
    light.outer_cone_rad = 0.9;
    scene.lights.push_back(light);
    build_tree(scene);
    return scene;
}

LightKind kind_of(const benchmark::State& state) { return static_cast<LightKind>(state.range(1)); }

void decide(const SceneSnapshot& scene, shadow::ShadowFrame& frame) {
    gl::DeviceInfo device;
    device.max_texture_px = device.max_cube_px = 16384;  // a large one's, so that no map is cut
    shadow::decide_demand(scene, device, true, {}, frame.demands);
}

void note(benchmark::State& state, const shadow::ShadowFrame& frame) {
    state.counters["seen"] = static_cast<double>(frame.sets[0].receivers.count);
    state.counters["casters"] = static_cast<double>(frame.sets[0].casters.count);
}

void run_sets(benchmark::State& state, double sight_m) {
    const SceneSnapshot scene = plain(state.range(0), kind_of(state), sight_m);
    shadow::ShadowFrame frame;
    decide(scene, frame);
    for (auto _ : state) shadow::select_sets(scene, frame);
    note(state, frame);
    state.SetComplexityN(state.range(0));
    state.SetLabel(std::string(shadow::light_kind_row(kind_of(state)).name));
}

constexpr double kSight_m = 60.0;

void sets_all_seen(benchmark::State& state) { run_sets(state, 0.0); }
void sets_sight_60_m(benchmark::State& state) { run_sets(state, kSight_m); }

/// The lists of each view, which need a fit first; the fit is not timed.
void view_casters(benchmark::State& state) {
    const SceneSnapshot scene = plain(state.range(0), kind_of(state), 0.0);
    shadow::ShadowFrame frame;
    decide(scene, frame);
    shadow::select_sets(scene, frame);
    shadow::fit_views(scene, {}, frame);
    for (auto _ : state) {
        frame.view_caster_items.clear();
        for (shadow::ShadowView& view : frame.views) shadow::select_view_casters(scene, view, frame);
    }
    note(state, frame);
    state.counters["views"] = static_cast<double>(frame.views.size());
    state.counters["listed"] = static_cast<double>(frame.view_caster_items.size());
    state.SetComplexityN(state.range(0));
    state.SetLabel(std::string(shadow::light_kind_row(kind_of(state)).name));
}

/// One fit alone, to the receivers that are seen.
void fit(benchmark::State& state) {
    const SceneSnapshot scene = plain(state.range(0), kind_of(state), 0.0);
    shadow::ShadowFrame frame;
    decide(scene, frame);
    shadow::select_sets(scene, frame);
    const shadow::PotentialSets& sets = frame.sets[0];
    shadow::HeldLight held, next;
    const auto part = [](const auto& items, shadow::IndexRange range) {
        return std::span(items).subspan(range.first, range.count);
    };
    const shadow::FitInput input{.light = scene.lights[0],
                                 .demand = frame.demands[0],
                                 .scene = scene,
                                 .receivers = part(frame.receiver_items, sets.receivers),
                                 .casters = part(frame.caster_items, sets.casters),
                                 .receiver_points_ws = part(frame.receiver_points_ws, sets.receiver_points),
                                 .beams = part(frame.beams, sets.beams),
                                 .frame_points_ws = frame.receiver_points_ws,
                                 .reach_texel = shadow::filter_row(frame.demands[0].filter).reach_texel,
                                 .scratch = frame.fit_scratch,
                                 .held = held,
                                 .next = next};
    std::vector<shadow::ShadowView> views;
    for (auto _ : state) {
        views.clear();
        next = held;
        benchmark::DoNotOptimize(shadow::light_kind_row(kind_of(state)).fit(input, views));
    }
    note(state, frame);
    state.counters["views"] = static_cast<double>(views.size());
    state.SetComplexityN(static_cast<std::int64_t>(sets.receivers.count));
    state.SetLabel(std::string(shadow::light_kind_row(kind_of(state)).name));
}

void tree_build(benchmark::State& state) {
    SceneSnapshot scene = plain(state.range(0), LightKind::point, 0.0);
    for (auto _ : state) build_tree(scene);
    state.SetComplexityN(state.range(0));
}

/// `moved` of the instances go a centimetre up and down.
void run_refit(benchmark::State& state, std::int64_t moved) {
    SceneSnapshot scene = plain(state.range(0), LightKind::point, 0.0);
    for (std::int64_t i = 0; i < moved; ++i)
        scene.changed_instances.push_back(static_cast<std::uint32_t>(i * state.range(0) / moved));
    double step_m = 0.01;
    for (auto _ : state) {
        state.PauseTiming();
        for (const std::uint32_t i : scene.changed_instances) {
            scene.instances[i].bounds_ws.min.y += step_m;
            scene.instances[i].bounds_ws.max.y += step_m;
        }
        step_m = -step_m;
        state.ResumeTiming();
        refit_tree(scene);
    }
    state.SetComplexityN(state.range(0));
}

constexpr std::int64_t kFew = 100;

void tree_refit_all(benchmark::State& state) { run_refit(state, state.range(0)); }
void tree_refit_100(benchmark::State& state) { run_refit(state, kFew); }

const std::vector<std::int64_t> kBoxes = {1000, 10000, 100000};

void add_per_kind(const char* name, void (*run)(benchmark::State&)) {
    for (const shadow::LightKindRow& kind : shadow::light_kind_table()) {
        const std::string full = std::string(name) + "_" + std::string(kind.name);
        benchmark::internal::Benchmark* added = benchmark::RegisterBenchmark(full.c_str(), run);
        for (const std::int64_t n : kBoxes) added->Args({n, static_cast<std::int64_t>(kind.kind)});
        added->Unit(benchmark::kMicrosecond)->Complexity();
    }
}

void add(const char* name, void (*run)(benchmark::State&)) {
    benchmark::internal::Benchmark* added = benchmark::RegisterBenchmark(name, run);
    for (const std::int64_t n : kBoxes) added->Arg(n);
    added->Unit(benchmark::kMicrosecond)->Complexity();
}

}  // namespace

void run_culling(const std::string& filter) {
    add_per_kind("sets_all_seen", sets_all_seen);
    add_per_kind("sets_sight_60_m", sets_sight_60_m);
    add_per_kind("view_casters", view_casters);
    add_per_kind("fit", fit);
    add("tree_build", tree_build);
    add("tree_refit_all", tree_refit_all);
    add("tree_refit_100", tree_refit_100);
    std::string program = "gnomon_bench", wanted = "--benchmark_filter=" + filter;
    char* arguments[] = {program.data(), wanted.data(), nullptr};
    int count = filter.empty() ? 1 : 2;
    benchmark::Initialize(&count, arguments);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}

}  // namespace gnomon::bench
