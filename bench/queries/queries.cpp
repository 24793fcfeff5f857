#include "bench/queries/queries.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <glm/geometric.hpp>
#include <random>

#include "bench/common/median_range.h"
#include "bench/text/printf_string.h"
#include "sample_game/support/scene/open_scene.h"
#include "systems/extract/extract.h"
#include "systems/transform/transform_system.h"
#include "systems/visibility/light_queries.h"

namespace gnomon::bench {
namespace {

using visibility::Place;

constexpr std::uint64_t kSeed = 20240917;
/// A lamp this far below the top of the scene's box, above its middle.
constexpr double kLampHeight = 0.3;
/// Places on surfaces are lifted by this share of the scene's longest side.
constexpr double kLift = 1e-5;
constexpr std::size_t kSmallBatch = 256;

double seconds_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Measures the time that all threads together spent: a busy machine stretches it less than wall-clock time.
double cpu_seconds_of(const auto& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Scene without a GPU, and the queries on it.
class QueryBench {
public:
    QueryBench(assets::SceneData scene, const StageOptions& stage, const QueriesOptions& options) : options_(options) {
        spawned_ = game::spawn_scene(std::move(scene), world_, library_);
        move_to(stage.time_s);
        for (const InstanceItem& item : snapshot_.instances) bounds_ = math::merged(bounds_, item.bounds_ws);
    }

    std::string table() {
        std::string text = trees();
        text += formatted("million queries per second, %u places, %u threads: median [least most] of %u\n",
                          options_.places, options_.threads, options_.repeat);
        text += "light                places           lit   one batch             per core              256 a batch\n";
        for (const LightItem& light : lights())
            for (const auto& [name, places] :
                 {std::pair("anywhere", anywhere()), std::pair("on surfaces", on_surfaces())})
                text += row(light, name, places);
        return text;
    }

private:
    void move_to(double time_s) {
        game::set_time(spawned_, time_s, world_);
        extractor_.update(world_, library_, transforms_.update(world_), {1280, 720}, snapshot_);
    }

    std::string trees() {
        std::vector<double> builds_ms, refits_ms;
        for (std::uint32_t i = 0; i < options_.repeat; ++i) {
            visibility::CasterTrees trees(library_);
            builds_ms.push_back(1e3 * seconds_of([&] { trees.update(snapshot_); }));
        }
        trees_.update(snapshot_);
        const visibility::CasterTrees::Counts built = trees_.counts();
        std::uint32_t refitted = 0;
        for (std::uint32_t i = 1; i <= options_.repeat; ++i) {
            move_to(0.1 * i);
            refits_ms.push_back(1e3 * seconds_of([&] { trees_.update(snapshot_); }));
            refitted = trees_.counts().refits;
        }
        const Spread build = spread_of(builds_ms), refit = spread_of(refits_ms);
        std::string text =
            formatted("%zu trees of %zu triangles, %zu bytes (%.1f a triangle)\n", built.trees, built.triangles,
                      built.bytes, static_cast<double>(built.bytes) / static_cast<double>(built.triangles));
        text += formatted("built in %.1f ms [%.1f %.1f]", build.median, build.min, build.max);
        text += formatted(", %u refitted in %.3f ms [%.3f %.3f]\n", refitted, refit.median, refit.min, refit.max);
        return text;
    }

    /// Returns the scene's own lights, and a lamp in its upper middle.
    std::vector<LightItem> lights() const {
        std::vector<LightItem> lights = snapshot_.lights;
        LightItem& lamp = lights.emplace_back();
        lamp.name = "lamp in the middle";
        lamp.position_ws_m = math::centre(bounds_);
        lamp.position_ws_m.y = bounds_.max.y - kLampHeight * (bounds_.max.y - bounds_.min.y);
        return lights;
    }

    std::vector<Place> anywhere() const {
        std::mt19937_64 random(kSeed);
        std::uniform_real_distribution<double> share(0.0, 1.0);
        std::vector<Place> places(options_.places);
        for (Place& place : places) {
            const glm::dvec3 at(share(random), share(random), share(random));
            place.at_ws_m = bounds_.min + at * (bounds_.max - bounds_.min);
        }
        return places;
    }

    /// Returns places just off both sides of the triangles, in proportion to their area.
    std::vector<Place> on_surfaces() const {
        struct Corner {
            glm::dvec3 a, ab, ac, normal;
        };
        std::vector<Corner> triangles;
        std::vector<double> areas;
        for (const InstanceItem& item : snapshot_.instances) {
            const assets::Mesh& mesh = library_.meshes[item.mesh];
            const auto at = [&](std::size_t i) {
                return item.basis * glm::dvec3(mesh.vertices[mesh.indices[i]].position_ms) + item.translation_ws_m;
            };
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                const glm::dvec3 a = at(i), ab = at(i + 1) - a, ac = at(i + 2) - a, n = glm::cross(ab, ac);
                if (!(glm::length(n) > 0.0)) continue;
                triangles.push_back({a, ab, ac, glm::normalize(n)});
                areas.push_back(glm::length(n));
            }
        }
        std::mt19937_64 random(kSeed);
        std::discrete_distribution<std::size_t> pick(areas.begin(), areas.end());
        std::uniform_real_distribution<double> share(0.0, 1.0);
        const glm::dvec3 size = bounds_.max - bounds_.min;
        const double lift_m = kLift * std::max({size.x, size.y, size.z});
        std::vector<Place> places(options_.places);
        for (Place& place : places) {
            const Corner& t = triangles[pick(random)];
            const double u = std::sqrt(share(random)), v = share(random);
            place.at_ws_m = t.a + t.ab * (u * (1.0 - v)) + t.ac * (u * v) + t.normal * lift_m;
        }
        return places;
    }

    /// Queries per second, in millions: by the clock, and of one core's time.
    struct Rates {
        Spread clock, core;
    };

    Rates rates(const LightItem& light, const std::vector<Place>& places, unsigned threads, std::size_t batch) {
        visibility::QueryOptions query;
        query.threads = threads;
        std::vector<double> clock, core;
        const auto ask = [&] {
            for (std::size_t at = 0; at < places.size(); at += batch) {
                const std::size_t count = std::min(batch, places.size() - at);
                queries_.ask(snapshot_, light, std::span(places).subspan(at, count), query,
                             std::span(answers_).subspan(at, count));
            }
        };
        ask();
        const double millions = 1e-6 * static_cast<double>(places.size());
        for (std::uint32_t i = 0; i < options_.repeat; ++i) {
            double s = 0.0;
            const double core_s = cpu_seconds_of([&] { s = seconds_of(ask); });
            clock.push_back(millions / s);
            core.push_back(millions / core_s);
        }
        return {spread_of(clock), spread_of(core)};
    }

    std::string row(const LightItem& light, const char* name, const std::vector<Place>& places) {
        answers_.resize(places.size());
        const Rates whole = rates(light, places, options_.threads, places.size());
        const Rates small = rates(light, places, 1, kSmallBatch);
        double lit = 0.0;
        for (const float answer : answers_) lit += static_cast<double>(answer);
        std::string text = formatted("%-20.20s %-12s %5.1f %%", light.name.c_str(), name,
                                     100.0 * lit / static_cast<double>(places.size()));
        for (const Spread& spread : {whole.clock, whole.core, small.core})
            text += formatted("  %6.2f [%5.2f %5.2f]", spread.median, spread.min, spread.max);
        return text + "\n";
    }

    QueriesOptions options_;
    ecs::Registry world_;
    assets::MeshLibrary library_;
    game::SpawnedScene spawned_;
    TransformSystem transforms_;
    Extractor extractor_;
    SceneSnapshot snapshot_;
    math::Aabb bounds_;
    visibility::CasterTrees trees_{library_};
    visibility::LightQueries queries_{trees_};
    std::vector<float> answers_;
};

}  // namespace

Result<std::string> measure_queries(const StageOptions& stage, const QueriesOptions& options) {
    auto scene = game::load_scene(stage.scene);
    if (!scene) return scene.error();
    return QueryBench(std::move(scene).value(), stage, options).table();
}

}  // namespace gnomon::bench
