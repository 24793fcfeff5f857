#include "bench/culling/city_time.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "bench/common/median_range.h"
#include "engine/core/workers.h"
#include "engine/gl/device_recording.h"
#include "sample_game/support/scene/open_scene.h"
#include "systems/extract/extract.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/shadow_system.h"
#include "systems/transform/transform_system.h"

namespace gnomon::bench {
namespace {

constexpr std::uint32_t kCityFramesBefore = 40, kCityFrames = 40;
constexpr double kFrame_s = 1.0 / 60.0;
constexpr glm::uvec2 kSize_px{640, 360};
constexpr std::array kStages = {"request", "culling", "fitting", "budget", "maps", "update", "passes", "publish"};

class CityWorld {
public:
    CityWorld(assets::SceneData data, std::size_t threads)
        : workers_(threads), scene_(game::spawn_scene(std::move(data), world_, library_)) {
        auto gpu = GpuScene::create(device_, library_);
        gpu_ = std::make_unique<GpuScene>(std::move(gpu).value());
        shadows_ = std::make_unique<shadow::ShadowSystem>(device_, shadow::History{}, &workers_);
        shadows_->watch_stages([this](std::string_view stage, const shadow::ShadowFrame&) {
            const auto now = std::chrono::steady_clock::now();
            us_[std::string(stage)].push_back(std::chrono::duration<double, std::micro>(now - last_).count());
            last_ = now;
        });
    }
    ~CityWorld() {
        shadows_.reset();
        gpu_.reset();
    }

    /// Returns medians, milliseconds: one per stage of kStages, and of all together.
    std::vector<double> run(const char* camera) {
        game::activate_camera(scene_, game::find_camera(scene_, camera).value(), world_);
        std::vector<double> all_us;
        for (std::uint32_t i = 0; i < kCityFramesBefore + kCityFrames; ++i) {
            if (i == kCityFramesBefore) us_.clear();
            const double cost_us = run_frame();
            if (i >= kCityFramesBefore) all_us.push_back(cost_us);
        }
        std::vector<double> ms;
        for (const char* stage : kStages) ms.push_back(spread_of(us_[stage]).median / 1e3);
        ms.push_back(spread_of(all_us).median / 1e3);
        return ms;
    }

private:
    double run_frame() {
        game::set_time(scene_, time_s_ += kFrame_s, world_);
        extractor_.update(world_, library_, transforms_.update(world_), kSize_px, snapshot_);
        list_.clear();
        report_.clear();
        gpu_->update(snapshot_, list_);
        list_.clear();
        last_ = std::chrono::steady_clock::now();
        shadows_->update(snapshot_, *gpu_, {}, list_, report_);
        shadows_->commit(snapshot_, true);
        return report_.shadow_cpu_us;
    }

    Workers workers_;
    gl::RecordingDevice device_;
    assets::MeshLibrary library_;
    ecs::Registry world_;
    game::SpawnedScene scene_;
    TransformSystem transforms_;
    Extractor extractor_;
    SceneSnapshot snapshot_;
    std::unique_ptr<GpuScene> gpu_;
    std::unique_ptr<shadow::ShadowSystem> shadows_;
    gl::CommandList list_;
    FrameReport report_;
    std::chrono::steady_clock::time_point last_;
    std::map<std::string, std::vector<double>> us_;  // by stage
    double time_s_ = 0.0;
};

}  // namespace

std::string city_time_table() {
    std::string table = "| camera | threads |", rule = "|---|---|";
    for (const char* stage : kStages) table += std::string(" ") + stage + " |", rule += "---|";
    table += " all stages |\n" + rule + "---|\n";
    const std::size_t all = Workers(0).threads();
    for (const std::size_t threads : {std::size_t{1}, all}) {
        auto data = game::load_scene(game::kCityScene);
        if (!data) return {};
        CityWorld world(std::move(data).value(), threads);
        for (const char* camera : {"street", "drive"}) {
            table += std::string("| ") + camera + " | " + std::to_string(threads) + " |";
            for (const double ms : world.run(camera)) {
                char cell[32];
                std::snprintf(cell, sizeof cell, " %.2f ms |", ms);
                table += cell;
            }
            table += "\n";
        }
        if (all == 1) break;
    }
    return table;
}

}  // namespace gnomon::bench
