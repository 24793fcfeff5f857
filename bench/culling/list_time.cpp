#include "bench/culling/list_time.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <vector>

#include "bench/scaling/many_lights_scene.h"
#include "systems/embed/scene_store.h"
#include "systems/extract/extract.h"

namespace gnomon::bench {
namespace {

/// Returns the place of the n-th of many boxes, on a square grid.
glm::dvec3 place_m(std::int64_t n) {
    constexpr std::int64_t kRow = 400;
    constexpr double kApart_m = 4.0;
    return {kApart_m * static_cast<double>(n % kRow), 0.0, kApart_m * static_cast<double>(n / kRow)};
}

/// Casters behind gnomon::Shadows.
class EmbeddedList {
public:
    explicit EmbeddedList(std::int64_t count) : mesh_(store_.add_box("box", {glm::dvec3(-1.0), glm::dvec3(1.0)})) {
        for (std::int64_t i = 0; i < count; ++i) add(i);
        next_ = count;
    }
    void change() {
        const std::size_t at = static_cast<std::size_t>(next_ * 7919) % casters_.size();
        store_.remove(casters_[at]);
        casters_[at] = casters_.back();
        casters_.pop_back();
        add(next_++ % static_cast<std::int64_t>(casters_.size()));
    }
    void update() { store_.update(cameras_); }

private:
    void add(std::int64_t at) {
        casters_.push_back(
            store_.add_caster({.mesh = mesh_, .world_from_mesh = glm::translate(glm::dmat4(1.0), place_m(at))}));
    }
    embed::SceneStore store_;
    MeshId mesh_;
    std::vector<CasterId> casters_;
    std::vector<ConsumerItem> cameras_{1};
    std::int64_t next_ = 0;
};

/// Entities of the registry.
class ExtractedList {
public:
    explicit ExtractedList(std::int64_t count) {
        library_.materials.emplace_back();
        library_.meshes.push_back(box_mesh("box", glm::dvec3(-1.0), glm::dvec3(1.0)));
        for (std::int64_t i = 0; i < count; ++i) add(i);
        next_ = count;
    }
    void change() {
        const std::size_t at = static_cast<std::size_t>(next_ * 7919) % entities_.size();
        registry_.destroy(entities_[at]);
        entities_[at] = entities_.back();
        entities_.pop_back();
        add(next_++ % static_cast<std::int64_t>(entities_.size()));
    }
    void update() {
        const TransformReport& report = transforms_.update(registry_);
        extractor_.update(registry_, library_, report, {1280, 720}, snapshot_);
    }

private:
    void add(std::int64_t at) {
        const ecs::Entity e = entities_.emplace_back(registry_.create());
        registry_.emplace<Transform>(e, {.translation_m = place_m(at)});
        registry_.emplace<MeshRef>(e, {0});
        registry_.emplace<ShadowCaster>(e);
    }
    ecs::Registry registry_;
    assets::MeshLibrary library_;
    TransformSystem transforms_;
    Extractor extractor_;
    SceneSnapshot snapshot_;
    std::vector<ecs::Entity> entities_;
    std::int64_t next_ = 0;
};

template <class List>
void list_made(benchmark::State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        auto list = std::make_unique<List>(state.range(0));
        state.ResumeTiming();
        list->update();
        state.PauseTiming();
        list.reset();
        state.ResumeTiming();
    }
    state.SetComplexityN(state.range(0));
}

template <class List>
void list_kept(benchmark::State& state) {
    List list(state.range(0));
    list.update();
    for (auto _ : state) {
        list.change();
        list.update();
    }
    state.SetComplexityN(state.range(0));
}

}  // namespace

std::array<ListBenchmark, 4> list_benchmarks() {
    return {{{"list_shadows_made", list_made<EmbeddedList>},
             {"list_shadows_one_comes_and_goes", list_kept<EmbeddedList>},
             {"list_ecs_made", list_made<ExtractedList>},
             {"list_ecs_one_comes_and_goes", list_kept<ExtractedList>}}};
}

}  // namespace gnomon::bench
