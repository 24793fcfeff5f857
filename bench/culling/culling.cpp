#include "bench/culling/culling.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <string_view>
#include <vector>

#include "bench/common/box_field_scene.h"
#include "bench/culling/city_time.h"
#include "bench/culling/fit_time.h"
#include "bench/culling/list_time.h"
#include "bench/culling/many_views.h"
#include "bench/culling/update_time.h"
#include "engine/core/workers.h"
#include "systems/extract/scene_tree.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/culling/view_casters.h"
#include "systems/shadow/fitting/fit_light.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {
namespace {

LightKind kind_of(const benchmark::State& state) { return static_cast<LightKind>(state.range(1)); }

void note(benchmark::State& state, const shadow::FitStages& stages) {
    const shadow::LightSets& sets = stages.frame.sets.lights[0];
    state.counters["seen"] = static_cast<double>(sets.receivers.count);
    state.counters["casters"] = static_cast<double>(sets.casters.count);
}

void run_sets(benchmark::State& state, double sight_m) {
    const SceneSnapshot scene = plain(state.range(0), kind_of(state), sight_m);
    shadow::FitStages stages;
    stages.decide(scene);
    for (auto _ : state) stages.select(scene);
    note(state, stages);
    state.SetComplexityN(state.range(0));
    state.SetLabel(std::string(shadow::light_kind_row(kind_of(state)).name));
}

constexpr double kSight_m = 60.0;

void sets_all_seen(benchmark::State& state) { run_sets(state, 0.0); }
void sets_sight_60_m(benchmark::State& state) { run_sets(state, kSight_m); }

/// Times the search for each view's casters. The fit before it is not timed.
void view_casters(benchmark::State& state) {
    const SceneSnapshot scene = plain(state.range(0), kind_of(state), 0.0);
    shadow::FitStages stages;
    stages.decide(scene);
    stages.select(scene);
    stages.fit(scene);
    shadow::FittedViews& fitted = stages.frame.fitted;
    const shadow::CasterInputs inputs{fitted.sets_of(stages.frame.sets, 0), fitted.lights[0].request.map.filtering, {}};
    for (auto _ : state) {
        fitted.casters.clear();
        for (shadow::ShadowView& view : fitted.views)
            shadow::select_view_casters(scene, inputs, view, stages.storage.scratch.front().sets, fitted.casters);
    }
    note(state, stages);
    state.counters["views"] = static_cast<double>(fitted.views.size());
    state.counters["listed"] = static_cast<double>(fitted.casters.size());
    state.SetComplexityN(state.range(0));
    state.SetLabel(std::string(shadow::light_kind_row(kind_of(state)).name));
}

/// Times one fit alone, to the visible receivers.
void fit(benchmark::State& state) {
    const SceneSnapshot scene = plain(state.range(0), kind_of(state), 0.0);
    shadow::FitStages stages;
    stages.decide(scene);
    stages.select(scene);
    shadow::LightFitHistory previous, next;
    const shadow::FitInput input = fit_input(scene, stages, previous, next);
    std::vector<shadow::ShadowView> views;
    for (auto _ : state) {
        views.clear();
        next = previous;
        benchmark::DoNotOptimize(shadow::light_kind_row(kind_of(state)).fit(input, views));
    }
    note(state, stages);
    state.counters["views"] = static_cast<double>(views.size());
    state.SetComplexityN(static_cast<std::int64_t>(stages.frame.sets.lights[0].receivers.count));
    state.SetLabel(std::string(shadow::light_kind_row(kind_of(state)).name));
}

void tree_build(benchmark::State& state) {
    SceneSnapshot scene = plain(state.range(0), LightKind::point, 0.0);
    for (auto _ : state) build_tree(scene);
    state.SetComplexityN(state.range(0));
}

/// Times fits while `moved` of the instances go a centimetre up and down.
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

void add_per_threads(const ViewsBenchmark& views) {
    const auto all = static_cast<std::int64_t>(Workers(0).threads());
    benchmark::internal::Benchmark* added = benchmark::RegisterBenchmark(views.name, views.run);
    for (const std::int64_t n : kBoxes) {
        added->Args({n, 1});
        if (all > 1) added->Args({n, all});
    }
    added->Unit(benchmark::kMicrosecond)->UseRealTime();
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
    add("read_boxes", read_boxes);
    for (const ViewsBenchmark& views : views_benchmarks()) add_per_threads(views);
    for (const ListBenchmark& list : list_benchmarks()) add(list.name, list.run);
    std::string program = "gnomon_bench", wanted = "--benchmark_filter=" + filter;
    char* arguments[] = {program.data(), wanted.data(), nullptr};
    int count = filter.empty() ? 1 : 2;
    benchmark::Initialize(&count, arguments);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    if (std::string_view("one_fit").find(filter) != std::string_view::npos) std::fputs(one_fit_table().c_str(), stdout);
    if (std::string_view("update").find(filter) != std::string_view::npos)
        std::fputs(update_cost_table().c_str(), stdout);
    if (std::string_view("city").find(filter) != std::string_view::npos) std::fputs(city_time_table().c_str(), stdout);
}

}  // namespace gnomon::bench
