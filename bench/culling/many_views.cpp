#include "bench/culling/many_views.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>

#include "bench/common/box_field_scene.h"
#include "engine/core/workers.h"
#include "engine/math/frustum.h"
#include "tests/oracle/fit_stages.h"

namespace gnomon::bench {
namespace {

constexpr std::uint32_t kSuns = 4, kCascades = 4, kSpots = 24, kPoints = 4;
constexpr double kNearSight_m = 60.0, kLampRange_m = 15.0, kCameraStep_m = 0.05;

/// Returns the plain with the lights of 64 views: lamps stand before the camera, within its sight.
SceneSnapshot plain_of_64_views(std::int64_t boxes, double sight_m) {
    SceneSnapshot scene = plain(boxes, LightKind::directional, sight_m);
    std::mt19937_64 random(11);
    const auto number = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    const LightItem pattern = scene.lights.front();
    const glm::dvec3 camera_m = scene.consumers.front().position_ws_m;
    scene.lights.clear();
    for (std::uint32_t i = 0; i < kSuns + kSpots + kPoints; ++i) {
        LightItem light = pattern;
        light.entity = {i + 1, 1};
        light.kind = i < kSuns ? LightKind::directional : i < kSuns + kSpots ? LightKind::spot : LightKind::point;
        light.shadow.resolution_px = 1024;
        light.shadow.cascades = kCascades;
        light.rotation_ws = math::basis_from_back(glm::dvec3(number(-0.5, 0.5), 1.0, number(-0.5, 0.5)));
        if (i >= kSuns) {
            light.position_ws_m = camera_m + glm::dvec3(number(-30.0, 30.0), number(-5.0, 0.0), -number(10.0, 50.0));
            light.range_m = kLampRange_m;
        }
        scene.lights.push_back(light);
    }
    return scene;
}

void run(benchmark::State& state, double sight_m) {
    SceneSnapshot scene = plain_of_64_views(state.range(0), sight_m);
    Workers workers(static_cast<std::size_t>(state.range(1)));
    shadow::FitStages stages;
    stages.jobs = &workers;
    shadow::History previous;
    double step_m = kCameraStep_m;
    for (auto _ : state) {
        state.PauseTiming();
        scene.consumers.front().position_ws_m.x += step_m;
        step_m = -step_m;
        stages.decide(scene, previous);
        state.ResumeTiming();
        stages.select(scene);
        stages.fit(scene, previous);
        state.PauseTiming();
        std::swap(previous, stages.frame.next_history);
        state.ResumeTiming();
    }
    state.counters["views"] = static_cast<double>(stages.frame.fitted.views.size());
    state.counters["seen"] = static_cast<double>(stages.frame.sets.receiver_items.size());
    state.counters["listed"] = static_cast<double>(stages.frame.fitted.casters.size());
    state.SetComplexityN(state.range(0));
}

}  // namespace

std::array<ViewsBenchmark, 2> views_benchmarks() {
    return {{{"views_64_all_seen", [](benchmark::State& state) { run(state, 0.0); }},
             {"views_64_sight_60_m", [](benchmark::State& state) { run(state, kNearSight_m); }}}};
}

void read_boxes(benchmark::State& state) {
    const SceneSnapshot scene = plain(state.range(0), LightKind::point, 0.0);
    for (auto _ : state) {
        double lowest_m = 0.0;
        for (const InstanceItem& item : scene.instances) lowest_m = std::min(lowest_m, item.bounds_ws.min.y);
        benchmark::DoNotOptimize(lowest_m);
    }
    state.SetComplexityN(state.range(0));
}

}  // namespace gnomon::bench
