#include "bench/culling/fit_time.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "bench/common/box_field_scene.h"
#include "bench/common/median_range.h"
#include "engine/math/frustum.h"
#include "systems/extract/light_facts.h"
#include "systems/extract/scene_tree.h"
#include "systems/shadow/culling/receiver_caster_sets.h"
#include "systems/shadow/fitting/directional/cascade_fit.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::bench {
namespace {

constexpr std::array<std::size_t, 3> kCounts = {100, 1000, 10000};
constexpr std::size_t kUsual = 1000;
constexpr std::int64_t kSceneBoxes = 16000;  // four of five are seen
constexpr int kRepeats = 101;
constexpr double kLeast_us = 200.0;  // least time of a measurement, so that the clock's own steps do not count

struct Kind {
    const char* name;
    LightKind kind;
    ShadowFit fit;
    bool whole_light;  // includes the work that a sun's views share: slices, and their points
};
constexpr Kind kKinds[] = {{"sun's view, tight", LightKind::directional, ShadowFit::tight, false},
                           {"sun's view, quantised", LightKind::directional, ShadowFit::quantised, false},
                           {"sun's view, stable", LightKind::directional, ShadowFit::stable, false},
                           {"sun of one, tight", LightKind::directional, ShadowFit::tight, true},
                           {"sun of one, quantised", LightKind::directional, ShadowFit::quantised, true},
                           {"sun of one, stable", LightKind::directional, ShadowFit::stable, true},
                           {"spot", LightKind::spot, ShadowFit::tight, true}};

/// Makes a scene with these numbers of receivers and casters. The light, with one view, reaches all.
SceneSnapshot scene_of(const Kind& kind, std::size_t receivers, std::size_t casters) {
    SceneSnapshot scene = plain(kSceneBoxes, kind.kind, 0.0);
    scene.lights[0].tuning.cascades.fit = kind.fit;
    scene.lights[0].shadow.cascades = 1;
    const double side_m = 5.0 * std::sqrt(static_cast<double>(kSceneBoxes));
    if (!light_facts(kind.kind).parallel) {
        scene.lights[0].position_ws_m = {0.0, side_m, 0.0};
        scene.lights[0].rotation_ws = math::basis_from_back({0.0, 1.0, 0.0});
    }
    shadow::FitStages all;
    all.decide(scene);
    all.select(scene);
    const shadow::ReceiverCasterSets& sets = all.frame.sets;
    for (InstanceItem& item : scene.instances) item.casts = item.receives = false;
    for (std::size_t i = 0; i < std::min(receivers, sets.receiver_items.size()); ++i)
        scene.instances[sets.receiver_items[i]].receives = true;
    for (std::size_t i = 0; i < std::min(casters, sets.caster_items.size()); ++i)
        scene.instances[sets.caster_items[i]].casts = true;
    build_tree(scene);
    return scene;
}

Spread measure(const Kind& kind, std::size_t receivers, std::size_t casters) {
    const SceneSnapshot scene = scene_of(kind, receivers, casters);
    shadow::FitStages stages;
    stages.decide(scene);
    stages.select(scene);
    shadow::LightFitHistory previous, next;
    const shadow::FitInput input = fit_input(scene, stages, previous, next);
    std::vector<shadow::ShadowView> views;
    const ConsumerItem& camera = scene.consumers[0];
    const glm::dmat3 basis = math::basis_from_back(scene.lights[0].rotation_ws[2]);
    const shadow::CascadeInput slice{input, basis, 0, camera.near_m, camera.far_m, false, input.receiver_points_ws};
    shadow::OrthographicBox box;
    const auto fit = [&] {
        views.clear();
        next = previous;
        return kind.whole_light ? shadow::light_kind_row(kind.kind).fit(input, views)
                                : shadow::cascade_fit(kind.fit)(slice, box);
    };
    const auto time_us = [&](int calls) {
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < calls; ++i) fit();
        return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count() / calls;
    };
    if (!fit()) std::abort();  // then there is nothing to measure
    const int calls = std::max(1, static_cast<int>(kLeast_us / std::max(time_us(1), 1e-3)));
    std::vector<double> each;
    for (int i = 0; i < kRepeats; ++i) each.push_back(time_us(calls));
    return spread_of(each);
}

/// Returns a line of measurements and the slope of cost over count, both in logarithms, from first to last. The slope
/// uses the least times: other work on the machine can only add.
template <class Measure>
std::string row(const char* name, const char* what, Measure measure_at) {
    std::array<Spread, kCounts.size()> at;
    for (std::size_t i = 0; i < kCounts.size(); ++i) at[i] = measure_at(kCounts[i]);
    const double slope = std::log(at.back().min / at.front().min) /
                         std::log(static_cast<double>(kCounts.back()) / static_cast<double>(kCounts.front()));
    std::string text;
    char cell[100];
    std::snprintf(cell, sizeof cell, "%-22s %-10s", name, what);
    text += cell;
    for (const Spread& s : at) {
        std::snprintf(cell, sizeof cell, " %9.2f (%.2f)", s.median, s.min);
        text += cell;
    }
    std::snprintf(cell, sizeof cell, "   %.2f\n", slope);
    return text + cell;
}

}  // namespace

std::string one_fit_table() {
    std::string table = "one view, us: median (least)     100           1000          10 000   slope\n";
    for (const Kind& kind : kKinds) {
        table += row(kind.name, "receivers", [&](std::size_t n) { return measure(kind, n, kUsual); });
        table += row(kind.name, "casters", [&](std::size_t n) { return measure(kind, kUsual, n); });
    }
    return table;
}

}  // namespace gnomon::bench
