#include "bench/culling/update_time.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "bench/common/box_field_scene.h"
#include "bench/common/median_range.h"
#include "bench/scaling/many_lights_scene.h"
#include "engine/gl/device_recording.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/scene_tree.h"
#include "systems/extract/splice_instances.h"
#include "systems/shadow/request/light_kinds.h"
#include "systems/shadow/shadow_system.h"

namespace gnomon::bench {
namespace {

constexpr std::int64_t kFewCasters = 10000, kManyCasters = 1000000;
constexpr double kWalkSight_m = 60.0, kStep_m = 1.4 / 60.0;
constexpr std::uint32_t kSettlingFrames = 70, kTimedFrames = 200;

enum class Motion : std::uint8_t { still, mover, comes_and_goes, walk };
constexpr std::array kMotions = {std::pair(Motion::still, "still"), std::pair(Motion::mover, "one mover"),
                                 std::pair(Motion::comes_and_goes, "one comes and goes"),
                                 std::pair(Motion::walk, "walk")};

assets::MeshLibrary boxes() {
    assets::MeshLibrary library;
    library.materials.emplace_back();
    for (std::uint32_t i = 0; i < kPlainMeshes; ++i)
        library.meshes.push_back(box_mesh("box", glm::dvec3(-1.0), glm::dvec3(1.0)));
    return library;
}

class PlainWorld {
public:
    PlainWorld(std::int64_t count, LightKind kind) : library_(boxes()), scene_(plain(count, kind, kWalkSight_m)) {
        scene_.version = scene_.list_version = scene_.tree_version = 1;
        for (InstanceItem& item : scene_.instances) item.version = 1;
        scene_.lights[0].entity = {1, 0};
        scene_.gpu_slot_count = static_cast<std::uint32_t>(scene_.instances.size());
        auto gpu = GpuScene::create(device_, library_);
        gpu_ = std::make_unique<GpuScene>(std::move(gpu).value());
        shadows_ = std::make_unique<shadow::ShadowSystem>(device_);
    }
    ~PlainWorld() {
        shadows_.reset();
        gpu_.reset();
    }

    Spread run(Motion motion) {
        std::vector<double> us;
        for (std::uint32_t i = 0; i < kSettlingFrames + kTimedFrames; ++i) {
            change(motion, i);
            const double cost_us = run_frame();
            if (i >= kSettlingFrames) us.push_back(cost_us);
        }
        return spread_of(us);
    }

private:
    void change(Motion motion, std::uint32_t frame) {
        scene_.changed_instances.clear();
        if (motion == Motion::walk) scene_.consumers[0].position_ws_m.z -= kStep_m;
        if (motion == Motion::comes_and_goes) return exchange();
        if (motion != Motion::mover || shadows_->frame().sets.receiver_items.empty()) return;
        const std::uint32_t mover = shadows_->frame().sets.receiver_items.front();
        InstanceItem& item = scene_.instances[mover];
        ++scene_.version;
        item.version = scene_.version;
        const double step_m = frame % 2 == 0 ? kStep_m : -kStep_m;
        item.translation_ws_m.x += step_m;
        item.bounds_ws.min.x += step_m;
        item.bounds_ws.max.x += step_m;
        scene_.changed_instances.push_back(mover);
        refit_tree(scene_);
    }

    /// Takes the first receiver out. The next call puts it in again.
    void exchange() {
        const bool comes = !splice_.removed.empty();
        if (!comes && shadows_->frame().sets.receiver_items.empty()) return;
        const std::uint32_t index = comes ? 0 : shadows_->frame().sets.receiver_items.front();
        ++scene_.version;
        if (comes) {
            splice_.added.swap(gone_);
            splice_.removed.clear();
        } else {
            gone_.assign(1, scene_.instances[index]);
            splice_.added.clear();
            splice_.removed.assign(1, index);
        }
        splice_instances(scene_, splice_);
    }

    double run_frame() {
        list_.clear();
        report_.clear();
        gpu_->update(scene_, list_);
        list_.clear();  // a million records without a reader
        const auto start = std::chrono::steady_clock::now();
        shadows_->update(scene_, *gpu_, {}, list_, report_);
        const auto end = std::chrono::steady_clock::now();
        shadows_->commit(scene_, true);
        return std::chrono::duration<double, std::micro>(end - start).count();
    }

    gl::RecordingDevice device_;
    assets::MeshLibrary library_;
    SceneSnapshot scene_;
    InstanceSplice splice_;
    std::vector<InstanceItem> gone_;
    std::unique_ptr<GpuScene> gpu_;
    std::unique_ptr<shadow::ShadowSystem> shadows_;
    gl::CommandList list_;
    FrameReport report_;
};

}  // namespace

std::string update_cost_table() {
    std::string table = "| light | | 10 000 casters | 1 000 000 | ratio |\n|---|---|---|---|---|\n";
    for (const shadow::LightKindRow& kind : shadow::light_kind_table()) {
        std::array<std::array<double, 2>, kMotions.size()> us{};
        for (const bool many : {false, true}) {
            PlainWorld world(many ? kManyCasters : kFewCasters, kind.kind);
            for (std::size_t m = 0; m < kMotions.size(); ++m) us[m][many] = world.run(kMotions[m].first).median;
        }
        for (std::size_t m = 0; m < kMotions.size(); ++m) {
            char row[160];
            std::snprintf(row, sizeof row, "| %s | %s | %.1f µs | %.1f µs | %.2f |\n", std::string(kind.name).c_str(),
                          kMotions[m].second, us[m][0], us[m][1], us[m][1] / us[m][0]);
            table += row;
        }
    }
    return table;
}

}  // namespace gnomon::bench
